"""ci/house: the repository keeps its rules, and each rule fires on a planted violation."""

import subprocess
import sys

import pytest

GOOD = {
    "common/fault.h": "#ifndef F\n#define F\nstruct fault;\nint fault_set(struct fault *f);\n#endif\n",
    "common/fault.c": '#include "common/fault.h"\n\nint fault_set(struct fault *f) {\n'
    '    return f != 0; /* printf("no {"); */\n}\n',
    "solver/model.h": '#include "common/fault.h"\nstruct model;\n'
    "const struct model *models_find(const char *name);\n",
    "solver/models.c": '#include "solver/model.h"\n\nstatic int count;\n\n'
    "const struct model *models_find(const char *name) {\n    count++;\n"
    "    return name ? 0 : 0;\n}\n",
    "solver/bedsim.c": '#include "solver/model.h"\n#include <stdio.h>\n\n'
    'int main(void) {\n    printf("%d\\n", 1);\n    return 0;\n}\n',
    "solver/graingas/halo.h": "struct halo { double s[4]; };\nextern const double halo_width;\n"
    "void halo_free(struct halo *h) __attribute__((visibility(\"hidden\")));\n",
    "solver/graingas/halo.c": '#include "solver/graingas/halo.h"\n\n'
    "const double halo_width = 1.37e-6;\nconst int graingas_table[2] = {1, 2};\n\n"
    "void halo_free(struct halo *h) {\n    (void)h;\n}\n",
    "report/report.h": "enum verdict { GOOD };\nconst char *verdict_name(enum verdict v);\n",
    "report/report.c": '#include "report/report.h"\n\n'
    'const char *verdict_name(enum verdict v) {\n    return v ? "}" : "exit(1)";\n}\n',
    "validation/bedcheck.c": '#include "report/report.h"\n\nint main(void) {\n    return 0;\n}\n',
}


def run_house(root, tree, tmp_path):
    for name, text in tree.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return subprocess.run(
        [sys.executable, "-B", str(root / "ci" / "house"), str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_repository_keeps_the_rules(root):
    done = subprocess.run(
        [sys.executable, "-B", str(root / "ci" / "house")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout


def test_a_good_tree_passes(root, tmp_path):
    done = run_house(root, GOOD, tmp_path)
    assert (done.returncode, done.stdout) == (0, "house: 10 files keep the rules\n")


BODY = "\n".join(f"    x += {i};" for i in range(58))

PLANTED = {
    "common includes a solver": (
        {"common/fault.c": '#include "solver/model.h"\n'},
        'common/fault.c:1: layers: this file may not include "solver/model.h"',
    ),
    "a model includes the other": (
        {
            "solver/suspension/layers.h": "struct layers;\n",
            "solver/graingas/halo.c": '#include "solver/suspension/layers.h"\n',
        },
        'solver/graingas/halo.c:1: layers: this file may not include "solver/suspension/layers.h"',
    ),
    "validation includes a solver": (
        {"validation/judge.c": '\n#  include "solver/graingas/halo.h"\n'},
        'validation/judge.c:2: layers: this file may not include "solver/graingas/halo.h"',
    ),
    "report includes validation": (
        {"validation/case.h": "\n", "report/html.c": '#include "validation/case.h"\n'},
        "report/html.c:1: layers:",
    ),
    "a path that is not from the root": (
        {"solver/graingas/halo.c": '#include "halo.h"\n'},
        'solver/graingas/halo.c:1: paths: "halo.h"',
    ),
    "a source is included": (
        {"common/file.c": '#include "common/fault.c"\n'},
        'common/file.c:1: paths: "common/fault.c" is no header',
    ),
    "headers in a circle": (
        {
            "common/a.h": '#include "common/b.h"\n',
            "common/b.h": '#include "common/c.h"\n',
            "common/c.h": '#include "common/a.h"\n',
        },
        "circles: common/a.h -> common/b.h -> common/c.h -> common/a.h",
    ),
    "a public function of no module": (
        {"common/fault.c": "int\nforgotten(int x) {\n    return x;\n}\n"},
        "common/fault.c:1: names: forgotten is public",
    ),
    "a public variable of no module": (
        {"solver/graingas/halo.c": "\ndouble width[2] = {1.5, 2.5};\n"},
        "solver/graingas/halo.c:2: names: width is public",
    ),
    "a name with the prefix of another module": (
        {"report/report.c": "int fault_hide(void) {\n    return 0;\n}\n"},
        "report/report.c:1: names: fault_hide is public",
    ),
    "a library prints": (
        {"report/report.c": '\nstatic void f(void) {\n    printf("x");\n}\n'},
        "report/report.c:3: quiet: a library must not use printf",
    ),
    "a library writes to stderr": (
        {"report/report.c": 'static void f(void) {\n    fprintf(stderr, "x");\n}\n'},
        "report/report.c:2: quiet: a library must not use stderr",
    ),
    "a library reads the environment": (
        {"common/file.c": 'static char *f(void) {\n    return getenv("HOME");\n}\n'},
        "common/file.c:2: quiet: a library must not use getenv",
    ),
    "a long file": (
        {"common/fault.c": "/* x */\n" * 601},
        "common/fault.c:600: length: 601 lines, at most 600",
    ),
    "a long function": (
        {"common/fault.c": f"\nstatic int f(int x) {{\n{BODY}\n    return x;\n}}\n"},
        "common/fault.c:2: length: f has 61 lines, at most 60",
    ),
    "a long function in a test": (
        {"tests/unit/test_a.c": f"START_TEST(a) {{\n{BODY}\n\n}}\n"},
        "tests/unit/test_a.c:1: length: START_TEST has 61 lines, at most 60",
    ),
}


@pytest.mark.parametrize("title", PLANTED)
def test_a_planted_violation_is_found(root, tmp_path, title):
    change, words = PLANTED[title]
    done = run_house(root, {**GOOD, **change}, tmp_path)
    assert done.returncode == 1
    assert words in done.stdout


def test_a_function_of_sixty_lines_passes(root, tmp_path):
    body = BODY.rpartition("\n")[0]
    text = f"static int f(int x) {{\n{body}\n    return x;\n}}\n"
    assert text.count("\n") == 60
    assert run_house(root, {**GOOD, "common/fault.c": text}, tmp_path).returncode == 0


def test_no_sources_and_bad_usage_are_trouble(root, tmp_path):
    assert run_house(root, {}, tmp_path).returncode == 2
