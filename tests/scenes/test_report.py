"""The report of a prompt's words: one definition, kept through JSON and counted."""

from hypothesis import given
from hypothesis import strategies as st

from texvent.prompt_report import REPORT_KEY, PromptReport, ReportTally, Substitution

WORDS = st.lists(st.text(min_size=1, max_size=6), max_size=4).map(tuple)
REPORTS = st.builds(
    PromptReport,
    scene=WORDS,
    shown=WORDS,
    substituted=st.lists(st.builds(Substitution, st.text(), st.text()), max_size=3).map(tuple),
    not_understood=WORDS,
    not_shown=WORDS,
    uncertain=WORDS,
    out_of_view=WORDS,
    too_small=WORDS,
    notes=WORDS,
)


@given(report=REPORTS)
def test_a_report_survives_json(report):
    assert PromptReport.from_json(report.to_json()) == report
    assert PromptReport.of_metadata({REPORT_KEY: report.to_json()}) == report
    assert PromptReport.of_metadata({"generator": "wan"}) is None


@given(report=REPORTS)
def test_a_report_is_faithful_if_and_only_if_nothing_is_to_refuse(report):
    assert report.is_faithful == (report.refusal() is None) == (not report.faults())


def test_the_refusal_names_every_word():
    report = PromptReport(
        substituted=(Substitution("spaniel", "dog"),),
        out_of_view=("table",),
        not_understood=tuple(f"w{number}" for number in range(12)),
    )
    said = report.refusal()
    assert said is not None
    for word in ("spaniel → dog", "out of view: table", "w0", "w11"):
        assert word in said


def test_a_tally_counts_prompts_and_words():
    tally = ReportTally()
    tally.add(PromptReport(not_understood=("wug",)))
    tally.add(PromptReport(not_understood=("wug", "dax"), out_of_view=("dog (1 of 2)",)))
    tally.add(PromptReport(shown=("dog",)))
    tally.add(None)
    assert tally.line() == (
        "1 of 4 prompts shown as they say; 2 with words not understood (wug (2), dax); "
        "1 with objects out of view (dog); 1 refused"
    )
    assert tally.tables["words"] == {
        "not_understood": {"wug": 2, "dax": 1},
        "out_of_view": {"dog": 1},
    }
