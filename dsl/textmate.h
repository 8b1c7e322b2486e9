/* textmate.h - the grammar by which editors colour scene texts, from the tables of the language. */
#ifndef RT_DSL_TEXTMATE_H
#define RT_DSL_TEXTMATE_H

/* A TextMate grammar as JSON, to be freed; NULL without memory. */
char *rt_textmate_grammar(void);

#endif
