"""Quality of the scenes that the embedded generator makes of prompts.

    python -m texvent_lab.measure.prompts public --vbench F --moviegen F --coco F -o DIR
    python -m texvent_lab.measure.prompts sheet PROMPTS.csv -o DIR --jobs 2
    python -m texvent_lab.measure.prompts score GRADES.csv

`public` draws prompts from published files, `sheet` draws film strips for a grader, and `score`
sums a grader's table.
"""
