/* date.c -- see date.h. */
#include "common/date.h"

#include <stddef.h>
#include <string.h>
#include <time.h>

bool date_is_day(const char *text) {
    struct tm day = {0};
    char again[16];
    const char *end = strptime(text, "%Y-%m-%d", &day);
    if (end == NULL || *end != '\0')
        return false;
    timegm(&day); /* 31 February becomes a day of March */
    return day.tm_year >= 100 && strftime(again, sizeof again, "%Y-%m-%d", &day) == 10 &&
           strcmp(again, text) == 0;
}
