/* SHA-256 in base 64, by which a content security policy knows a script. */
#ifndef CZ_REPORT_SHA256_H
#define CZ_REPORT_SHA256_H

#include <stddef.h>

enum { CZ_SHA256_ROOM = 48 }; /* of the base 64 text with its zero [byte] */

/* Digest of n bytes (FIPS 180-4) in base 64; returns text. */
const char *cz_sha256_base64(const char *bytes, size_t n, char text[CZ_SHA256_ROOM]);

#endif
