/* date.h -- days as stored texts name them: YYYY-MM-DD.
 *
 * Checked by: tests/unit/test_date.c.
 */
#ifndef COMMON_DATE_H
#define COMMON_DATE_H

#include <stdbool.h>

/* Is it a day that there is, of a year from 2000 on, and written so? */
bool date_is_day(const char *text);

#endif
