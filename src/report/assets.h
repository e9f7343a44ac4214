/* Style sheet and script of the report, report.css and report.js, made texts by the build, and
 * their SHA-256 in base 64, by which a content security policy knows them. */
#ifndef CZ_REPORT_ASSETS_H
#define CZ_REPORT_ASSETS_H

extern const char cz_report_css[];
extern const char cz_report_js[];
extern const char cz_report_css_sha256[];
extern const char cz_report_js_sha256[];

#endif
