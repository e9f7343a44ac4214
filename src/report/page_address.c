/* Addresses of the reports of scenarios, which are in folders of their names. */
#include "report/page.h"

#include <string.h>

void cz_page_folder_name(const char *scenario, char name[CZ_NAME_SIZE]) {
    snprintf(name, CZ_NAME_SIZE, "%s", scenario);
    for (char *c = name; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f || strchr("/\\:*?\"<>|", *c) != NULL)
            *c = '_';
    if (name[0] == '.')
        name[0] = '_';
}

/* Characters other than letters, digits and -._~ as %XX. */
void cz_page_address(const CzPage *page, const char *scenario, char address[CZ_ADDRESS_SIZE]) {
    char folder[CZ_NAME_SIZE];
    cz_page_folder_name(scenario, folder);
    size_t used = (size_t)snprintf(address, CZ_ADDRESS_SIZE, page->is_top ? "" : "../");
    for (const char *c = folder; *c != '\0' && used + 4 < CZ_ADDRESS_SIZE; c++) {
        const unsigned char byte = (unsigned char)*c;
        const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') ||
                           (byte >= 'A' && byte <= 'Z') || strchr("-._~", byte) != NULL;
        used +=
            (size_t)snprintf(address + used, CZ_ADDRESS_SIZE - used, plain ? "%c" : "%%%02X", byte);
    }
    snprintf(address + used, CZ_ADDRESS_SIZE - used, "/report.html");
}
