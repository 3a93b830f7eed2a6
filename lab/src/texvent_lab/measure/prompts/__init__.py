"""Quality of the scenes that the embedded generator makes of prompts.

    python -m texvent_lab.measure.prompts sheet PROMPTS.csv -o DIR --jobs 2
    python -m texvent_lab.measure.prompts score GRADES.csv

`sheet` draws film strips for a grader, and `score` sums a grader's table.
"""
