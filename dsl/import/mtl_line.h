/* mtl_line.h - lines of OBJ and MTL files: their words, names and files. */
#ifndef RT_DSL_IMPORT_MTL_LINE_H
#define RT_DSL_IMPORT_MTL_LINE_H

#include "dsl/import/import.h"

/* The next line of a text, which is taken apart; NULL at its end. Counts lines in *line. */
char *rt_mtl_next_line(char **text, int *line);

/* The next word of a line, or NULL; one that begins with # begins a comment. */
char *rt_mtl_next_word(char **line);

/* What is left of a line, without blanks around it: a name, which may hold blanks and #. */
char *rt_mtl_rest(char *line);

/* Ends a name before a # that begins it or follows a blank; returns whether there is one. */
int rt_mtl_cut_comment(char *rest);

/* The file that the rest of a line names; a # after a blank is part of its name if it is there. */
char *rt_mtl_file(const importer *import, char *line);

/*
 * The next file of several that a line names, or NULL: up to the next ".mtl" or the end, as names
 * may hold blanks; up to the next blank where only that is there.
 */
char *rt_mtl_next_library(const importer *import, char **rest);

#endif
