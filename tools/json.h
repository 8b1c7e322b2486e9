/* json.h - values as JSON on stdout. */
#ifndef RTC_JSON_H
#define RTC_JSON_H

/* "text", with its escapes. */
void json_string(const char *text);

/* A number; null for what JSON does not know, infinity and NaN. */
void json_number(double value);

/* ,"name":value */
void json_member(const char *name, double value);

/* ,"name":[value,value,value] */
void json_triple(const char *name, const double values[3]);

#endif
