/*
 * rt/common.h - what the interface shares with the kernels, in its place beside the other headers;
 * installed is the file itself.
 */
#include "../../kernels/common.h"
