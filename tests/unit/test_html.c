/* test_html.c -- index.html: self-contained, valid, every name shown as text. */
#include "common/file.h"
#include "report/gallery.h"
#include "tests/unit/sequence_sample.h"
#include "tests/unit/unit.h"

static char *written(const struct report *r, const char *folder) {
    struct fault fault = FAULT_NONE;
    char *text;
    size_t length;
    unit_ok(report_write_html(r, folder, &fault), &fault);
    unit_ok(file_read(unit_path(folder, "index.html"), 1 << 24, &text, &length, &fault), &fault);
    return text;
}

static void has(const char *text, const char *part) {
    ck_assert_msg(strstr(text, part) != NULL, "expected '%s'", part);
}

static size_t times(const char *text, const char *part) {
    size_t count = 0;
    for (const char *s = text; (s = strstr(s, part)) != NULL; s++)
        count++;
    return count;
}

/* Without tidy (the message says so) nothing is asked. */
static void is_valid(const char *folder) {
    char command[512];
    if (system("command -v tidy >/dev/null") != 0) {
        printf("tidy is not installed: the page was not validated\n");
        return;
    }
    snprintf(command, sizeof command, "tidy -q -e '%s'", unit_path(folder, "index.html"));
    ck_assert_int_eq(system(command), 0);
}

static int compare_texts(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* The values of all id attributes, sorted; ids[0 .. count-1], each to be freed. */
static size_t collect_ids(const char *text, char **ids, size_t room) {
    size_t count = 0;
    for (const char *s = text; (s = strstr(s, " id=")) != NULL; s += 5) {
        const char *end = strchr(s + 5, s[4]);
        ck_assert(count < room && end);
        ids[count++] = strndup(s + 5, (size_t)(end - s - 5));
    }
    qsort(ids, count, sizeof *ids, compare_texts);
    return count;
}

START_TEST(a_known_disagreement_has_a_colour_and_a_count_of_its_own) {
    struct sample s;
    sample_fill(&s);
    sample_know(&s);
    sample_budget(&s);
    const char *folder = unit_folder();
    char *text = written(&s.report, folder);
    has(text, "<li class=\"known\"><strong>1</strong> known disagreement</li>");
    has(text, "<span class=\"verdict known\">");
    has(text, "<div class=\"trouble known\">");
    has(text, "<p class=\"budget\">Unchanged code may raise a false alarm");
    has(text, "<p class=\"bits\">3 of 4 runs have the bits");
    has(text, ".verdict.known{color:var(--known)");
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(ids_are_unique_in_a_page_of_two_figures) {
    static char *ids[1000];
    struct sample s;
    sample_fill(&s);
    const char *folder = unit_folder();
    char *text = written(&s.report, folder);
    size_t count = collect_ids(text, ids, 1000);
    ck_assert_uint_gt(count, 25);
    for (size_t i = 1; i < count; i++)
        ck_assert_str_ne(ids[i - 1], ids[i]);
    for (size_t i = 0; i < count; i++)
        free(ids[i]);
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(foreign_names_are_text) {
    struct sample s;
    sample_fill(&s);
    const char *folder = unit_folder();
    char *text = written(&s.report, folder);
    ck_assert_ptr_null(strstr(text, "<b>x"));
    ck_assert_uint_eq(times(text, "<script"), 1); /* our own */
    ck_assert_ptr_null(strchr(text, '\x1b'));
    has(text, "&lt;b&gt;x&lt;/b&gt;&#39;; rm `id`");
    has(text, "&lt;script&gt;alert(1)&lt;/script&gt;");
    has(text, "href=\"#case-_3Cb_3Ex_3C.b_3E");
    has(text, "id=\"case-_3Cb_3Ex_3C.b_3E");
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(the_first_screen_answers) {
    struct sample s;
    sample_fill(&s);
    s.report.modified = true;
    s.report.modification = "restitution=0.5";
    const char *folder = unit_folder();
    char *text = written(&s.report, folder), *cases = strstr(text, "<main");
    ck_assert_ptr_nonnull(cases);
    *cases = '\0';
    has(text, "MODIFIED");
    has(text, "<code>restitution=0.5</code>");
    has(text, "2 of 5 checks fail, in 2 of 2 cases");
    has(text, "<dt>Worst failure</dt>\n<dd class=\"worst\"><p>Nothing measured by");
    has(text, "No check here compares with a stored reference.");
    has(text, "<code>graingas/fluidization</code>: no time | today");
    has(text, "0123abcd");
    has(text, "solver: source tree</b> changed since that commit");
    has(text, "2026-11-22T01:30:00Z");
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(what_is_not_covered_is_told) {
    struct sample s;
    sample_fill(&s);
    const struct report_limit limit[] = {
        {"suspension", "hydrodynamic <forces>", "the model has no flow"}};
    const char *unselected[] = {"graingas/packed-bed"};
    s.report.limit = limit;
    s.report.unselected = unselected;
    s.report.limit_count = s.report.unselected_count = 1;
    s.first[0].detectable = .0605;
    s.first[1].statistical = s.first[2].statistical = true;
    const char *folder = unit_folder();
    char *text = written(&s.report, folder);
    has(text, "1 more case of this tier was not asked for.");
    has(text, "What no check here can see</a>: hydrodynamic &lt;forces&gt;.</p>");
    has(text, "<b>hydrodynamic &lt;forces&gt;</b> (suspension): the model has no flow");
    has(text, "<code>graingas/packed-bed</code>");
    has(text, "5.0 % of what is expected for half of them, 3.9 % at best, 5.0 % at worst, over 2");
    has(text, "For the 1 others that hang on scatter it is not known");
    has(text, "<td class=\"num\">0.0605 U0</td><td class=\"num\">5.0 %</td>");
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(a_section_goes_from_question_to_command) {
    static const char *const order[] = {"Does it settle?",
                                        "v = v0",
                                        "snapshot.png",
                                        "<svg",
                                        "class=\"data\"",
                                        "class=\"check\"",
                                        "four seeds of an independent code",
                                        "Seeds and runs of",
                                        "To run just this case again"};
    struct sample s;
    sample_fill(&s);
    s.cases[0].equation = "v = v0 (1 - rho)";
    const char *folder = unit_folder();
    char *text = written(&s.report, folder), *at = strstr(text, "<section class=\"case\"");
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        ck_assert_ptr_nonnull(at);
        at = strstr(at, order[i]);
        ck_assert_msg(at != NULL, "%s is missing or too early", order[i]);
    }
    free(text);
    unit_remove(folder);
}
END_TEST

/* The digest that the policy names is that of the script as it stands in the page. */
START_TEST(only_the_pages_own_script_may_run) {
    struct sample s;
    char command[900];
    sample_fill(&s);
    const char *folder = unit_folder();
    free(written(&s.report, folder));
    snprintf(command, sizeof command,
             "python3 -c \"import base64,hashlib,re,sys; t=open(sys.argv[1]).read(); "
             "s=re.findall('<script>(.*?)</script>',t,re.S); assert len(s)==1; "
             "d=base64.b64encode(hashlib.sha256(s[0].encode()).digest()).decode(); "
             "assert 'script-src \\'sha256-'+d+'\\'\\\"' in t\" '%s'",
             unit_path(folder, "index.html"));
    if (system("command -v python3 >/dev/null") == 0)
        ck_assert_int_eq(system(command), 0);
    else
        printf("python3 is not installed: the script's digest was not checked\n");
    unit_remove(folder);
}
END_TEST

START_TEST(a_red_row_tells_how_to_repeat_it) {
    struct sample s;
    sample_fill(&s);
    const char *folder = unit_folder();
    char *text = written(&s.report, folder);
    has(text, "1.3137 lies above 1.2463");
    has(text, "bedsim run &#39;a b.yaml&#39; --seed 1101");
    has(text, "<code>graingas.sedimentation.1a2b3c4d-s1101</code>, <code>s1102</code>");
    has(text, "1.314 ± 0.012");
    has(text, "four seeds of an independent code");
    has(text, "bedcheck run graingas/sedimentation</code>");
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(the_page_needs_nothing_else_and_repeats) {
    struct sample s;
    sample_fill(&s);
    const char *folder = unit_folder();
    char *one = written(&s.report, folder), *two = written(&s.report, folder);
    ck_assert_str_eq(one, two);
    ck_assert_ptr_null(strstr(one, "src=\"http"));
    ck_assert_ptr_null(strstr(one, "href=\"http"));
    ck_assert_ptr_null(strstr(one, "url(http"));
    has(one, "default-src 'none'");
    has(one, "src=\"data:image/png;base64,iVBORw0KGgo");
    ck_assert(file_exists(unit_path(folder, "graingas.sedimentation.snapshot.png")));
    free(one);
    free(two);
    unit_remove(folder);
}
END_TEST

START_TEST(the_page_is_valid) {
    struct sample s;
    sample_fill(&s);
    s.report.modified = true;
    const char *folder = unit_folder();
    free(written(&s.report, folder));
    is_valid(folder);
    unit_remove(folder);
}
END_TEST

/* The gallery hangs the second figure of the first case, twice; the case has both of its own. */
START_TEST(a_figure_of_the_gallery_is_drawn_once) {
    struct sample s;
    sample_fill(&s);
    const struct report_gallery_item item = {.case_name = s.cases[0].name,
                                             .in = &s.cases[0],
                                             .begin = {[GALLERY_PLOT] = 1},
                                             .end = {[GALLERY_PLOT] = 2}};
    const struct report_gallery_entry entry[2] = {
        {.paper = "MFM", .figure = "Fig. 4", .shows = "a", .axes = "b", .count = 1, .item = &item},
        {.paper = "MFM", .figure = "Fig. 5", .shows = "c", .axes = "d", .count = 1, .item = &item}};
    const struct report_gallery gallery = {2, entry};
    const char *folder = unit_folder();
    char *text = written(&s.report, folder);
    size_t without = strlen(text), figures = times(text, "<svg id=\"");
    free(text);
    s.report.gallery = &gallery;
    text = written(&s.report, folder);
    ck_assert_uint_eq(times(text, "<svg id=\""), figures + 2);
    ck_assert_uint_eq(times(text, "<use xlink:href=\"#figure1-svg\"/></svg>"), 2);
    ck_assert_uint_eq(times(text, "<svg id=\"figure1-svg\""), 1);
    ck_assert_uint_eq(times(text, "<a href=\"#figure1-svg\">As in the gallery</a>"), 2);
    ck_assert_uint_lt(strlen(text), without + 4000);
    is_valid(folder);
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(sequences_stand_in_the_page_and_players_beside_it) {
    struct sample s;
    struct sequence_sample grains;
    sample_fill(&s);
    sequence_sample_fill(&grains);
    s.cases[0].sequence = s.cases[0].animation = &grains.sequence;
    s.cases[0].sequence_count = s.cases[0].animation_count = 1;
    const char *folder = unit_folder();
    char *text = written(&s.report, folder);
    has(text, "src=\"data:image/svg+xml,%3C?xml");
    has(text, "<a href=\"graingas.sedimentation.time-sequence-1.svg\">");
    has(text, "<a href=\"graingas.sedimentation.time-sequence-1.html\">");
    ck_assert_uint_eq(times(text, "<script"), 1);
    ck_assert_int_eq(access(unit_path(folder, "graingas.sedimentation.time-sequence-1.svg"), R_OK),
                     0);
    ck_assert_int_eq(access(unit_path(folder, "graingas.sedimentation.time-sequence-1.html"), R_OK),
                     0);
    is_valid(folder);
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(an_empty_report_is_a_page_too) {
    struct report r = {.suite = "bedcheck 0.1.0", .tier = "paper"};
    const char *folder = unit_folder();
    char *text = written(&r, folder);
    has(text, "NOTHING JUDGED");
    free(text);
    unit_remove(folder);
}
END_TEST

START_TEST(a_folder_that_cannot_be_made_is_named) {
    struct sample s;
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    sample_fill(&s);
    unit_write(unit_path(folder, "taken"), "x");
    ck_assert_int_eq(report_write_html(&s.report, unit_path(folder, "taken/report"), &fault),
                     STATUS_IO);
    unit_says(&fault, "taken");
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_known_disagreement_has_a_colour_and_a_count_of_its_own,
                                  a_figure_of_the_gallery_is_drawn_once,
                                  sequences_stand_in_the_page_and_players_beside_it,
                                  ids_are_unique_in_a_page_of_two_figures,
                                  foreign_names_are_text,
                                  the_first_screen_answers,
                                  what_is_not_covered_is_told,
                                  a_section_goes_from_question_to_command,
                                  only_the_pages_own_script_may_run,
                                  a_red_row_tells_how_to_repeat_it,
                                  the_page_needs_nothing_else_and_repeats,
                                  the_page_is_valid,
                                  an_empty_report_is_a_page_too,
                                  a_folder_that_cannot_be_made_is_named,
                                  NULL};
    return unit_run("html", tests);
}
