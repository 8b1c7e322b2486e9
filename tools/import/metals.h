/* metals.h - metals that scenes name, as colours. */
#ifndef RTC_IMPORT_METALS_H
#define RTC_IMPORT_METALS_H

/* eta and k of a metal by its sign, as Au or Cu, in linear sRGB; returns whether it is known. */
int metals_find(const char *name, double eta[3], double k[3]);

#endif
