/* gltf_triangle.h - what a glTF of one triangle has beside its materials. */
#ifndef RT_TESTS_GLTF_TRIANGLE_H
#define RT_TESTS_GLTF_TRIANGLE_H

/* The rest of a glTF file whose first material is that of a triangle. */
#define GLTF_TRIANGLE                                                                              \
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,"                                      \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"                                        \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"                                          \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"                         \
    "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"                                         \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"                               \
    "\"material\":0}]}],\"nodes\":[{\"mesh\":0}],"                                                 \
    "\"scenes\":[{\"nodes\":[0]}],\"scene\":0}"

#endif
