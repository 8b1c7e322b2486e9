/* schema.c - finds blocks and fields in the tables of the language. */
#include "dsl/schema.h"

#include <stdio.h>
#include <string.h>

const rt_block *rt_block_at(size_t index)
{
    if (index < RT_BLOCK_MESH)
        return &rt_blocks[index];
    index -= RT_BLOCK_MESH;
    return index < rt_shape_block_count ? &rt_shape_blocks[index] : NULL;
}

const rt_block *rt_schema_find(rt_text word, const rt_text *kind)
{
    const rt_block *block;
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++)
        if (rt_text_equal(word, block->word) && !block->kind == !kind &&
            (!kind || rt_text_equal(*kind, block->kind)))
            return block;
    return NULL;
}

int rt_schema_is_block(rt_text word)
{
    const rt_block *block;
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++)
        if (rt_text_equal(word, block->word))
            return 1;
    return 0;
}

const rt_field *rt_block_setting(const rt_block *block, size_t index)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++)
        if ((settings[i].topic == RT_TOPIC_FILM) == (block->id == RT_BLOCK_FILM) && index-- == 0)
            return &settings[i].field;
    return NULL;
}

const rt_field *rt_schema_field(const rt_block *block, rt_text name)
{
    const rt_field *field;
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++)
        if (rt_text_equal(name, field->name))
            return field;
    return NULL;
}

const char *rt_field_block(const char *name)
{
    const rt_block *block;
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++)
        if (block->id != RT_BLOCK_FILM && block->id != RT_BLOCK_RENDER &&
            rt_schema_field(block, (rt_text){name, strlen(name)}))
            return block->word;
    return NULL;
}

int rt_field_is_transform(const rt_field *field)
{
    return field->type >= RT_FIELD_TRANSLATE && field->type <= RT_FIELD_MATRIX;
}

const char *rt_block_title(char out[RT_BLOCK_TITLE_SIZE], const rt_block *block)
{
    snprintf(out, RT_BLOCK_TITLE_SIZE, "%s%s%s", block->word, block->kind ? " " : "",
             block->kind ? block->kind : "");
    return out;
}
