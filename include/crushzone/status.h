/* Statuses and errors.
 *
 * Every function that can fail returns a CzStatus and takes a caller-owned CzError last (it may be
 * NULL). The function that finds the error writes one sentence; callers pass it on. The library
 * never prints and never exits.
 */
#ifndef CRUSHZONE_STATUS_H
#define CRUSHZONE_STATUS_H

/* Around declarations, for callers in C++. */
#ifdef __cplusplus
#define CZ_BEGIN_DECLARATIONS extern "C" {
#define CZ_END_DECLARATIONS }
#else
#define CZ_BEGIN_DECLARATIONS
#define CZ_END_DECLARATIONS
#endif

CZ_BEGIN_DECLARATIONS

#if defined(__GNUC__)
#define CZ_MUST_CHECK __attribute__((warn_unused_result))
#define CZ_API __attribute__((visibility("default")))
#else
#define CZ_MUST_CHECK
#define CZ_API
#endif

typedef enum CzStatus {
#define CZ_STATUS(constant, exit_code, text) constant,
#include "crushzone/statuses.def"
#undef CZ_STATUS
} CzStatus;

/* An error and its place. Zero-initialise it before use. */
typedef struct CzError {
    CzStatus status;
    char file[256];    /* file of the error; empty when none */
    int line;          /* counted from 1; 0 when none */
    int column;        /* counted from 1; 0 when none */
    char message[512]; /* one sentence with the value and the limit */
    char help[256];    /* hint such as a did-you-mean; empty when none */
} CzError;

/* Text of a status, such as "input". */
CZ_API const char *cz_status_text(CzStatus status);

/* Exit code of the command line for a status. */
CZ_API int cz_status_exit_code(CzStatus status);

CZ_END_DECLARATIONS
#endif
