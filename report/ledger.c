#include "report/ledger.h"

#include <string.h>

static const char *const name[CLAIM_VERDICTS] = {"reproduced",      "not reproduced",
                                                 "underdetermined", "wrong in the paper",
                                                 "undecided",       "not tested"};

const char *claim_verdict_name(enum claim_verdict v) {
    return name[v];
}

bool claim_verdict_find(const char *text, enum claim_verdict *out) {
    for (enum claim_verdict v = 0; v < CLAIM_VERDICTS; v++) {
        if (strcmp(text, name[v]) != 0)
            continue;
        *out = v;
        return true;
    }
    return false;
}

void claim_tally(const struct report_ledger *l, size_t *count) {
    memset(count, 0, CLAIM_VERDICTS * sizeof *count);
    for (size_t i = 0; i < l->count; i++)
        count[l->claim[i].verdict]++;
}
