/* Style sheet and script of the report: report.css and report.js, made texts by the build. */
#ifndef CZ_REPORT_ASSETS_H
#define CZ_REPORT_ASSETS_H

extern const char cz_report_css[];
extern const char cz_report_js[];

#endif
