"""The report of a prompt's words: one definition, kept through JSON and counted."""

from hypothesis import given
from hypothesis import strategies as st

from texvent.prompt_report import REPORT_KEY, PromptReport, ReportTally, Substitution
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.spec.scene import Camera, CameraMove, Motion, Place, Scene, SceneObject

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


def test_turbines_at_stated_places_are_not_told_to_be_near_and_no_line_is_cut_off():
    turbines = [SceneObject("wind turbine", id=name, position_m=place, heading_deg=270,
                            motions=(Motion("work", rate_hz=rate_hz),))
                for name, place, rate_hz in (("near", (-12, 60), 0.25), ("far", (15, 80), 0.4))
                ]  # fmt: skip
    camera = Camera((CameraMove("static"),), position_m=(0, 0, 1.7), look_at_m=(0, 60, 14))
    scene = Scene(objects=(*turbines, SceneObject("box", position_m=(0, 9))), camera=camera,
                  place=Place("grass"))  # fmt: skip
    report = ProceduralGenerator(ProceduralConfig(duration=2.0)).report(scene)
    assert report.not_shown == ()
    for line, rate in zip(report.scene, ("0.25", "0.4"), strict=False):
        assert f"rate_hz = {rate}" in line
        assert "pace" not in line
    line = "the wind turbine in the distance: it is near, and larger than what stands before it"
    assert PromptReport(not_shown=(line,)).faults() == [f"not shown: {line}"]
