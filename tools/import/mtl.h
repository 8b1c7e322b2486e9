/* mtl.h - the materials of OBJ files. */
#ifndef RTC_IMPORT_MTL_H
#define RTC_IMPORT_MTL_H

#include "import.h"
#include "names.h"

/* Of the files of a scene. */
enum { MTL_MATERIALS_MAX = 10000, MTL_MAPS_MAX = 30000, MTL_LIBRARIES_MAX = 1000 };

/* All zero is empty. */
typedef struct mtl_list {
    name_table names;
    int *materials; /* their handles */
    int begun;      /* how many newmtl there were, those of a name that is there among them */
    int maps;
    name_table libraries; /* the files that were read */
} mtl_list;

/* Adds the materials of the MTL text of a file, which is taken apart. */
void mtl_read(importer *import, mtl_list *list, const char *file, char *text);

/* The material of that name, or IMPORT_NONE. */
int mtl_find(const mtl_list *list, const char *name);

void mtl_free(mtl_list *list);

/* The next line of a text, which is taken apart; NULL at its end. Counts lines in *line. */
char *mtl_next_line(char **text, int *line);

/* The next word of a line, or NULL. */
char *mtl_next_word(char **line);

#endif
