/* classes.h - the classes of all kinds of shape, each defined in the file of its name. */
#ifndef RT_LIB_SHAPE_CLASSES_H
#define RT_LIB_SHAPE_CLASSES_H

#include "scene/shape_class.h"
#include "shape/shapes.h"

#define RT_SHAPE_CLASS(KIND, name, number) extern const rt_shape_class rt_shape_##name;
RT_SHAPES(RT_SHAPE_CLASS)
#undef RT_SHAPE_CLASS

#endif
