/* animation.h -- what a page that plays an animation carries; only animation*.c include this. */
#ifndef REPORT_ANIMATION_H
#define REPORT_ANIMATION_H

const char *animation_script(void); /* animation_script.c */
const char *animation_style(void);

#endif
