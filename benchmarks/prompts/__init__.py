"""How well the embedded generator shows what prompts say.

    python -m benchmarks.prompts public --vbench F --moviegen F --coco F -o DIR
    python -m benchmarks.prompts sheet PROMPTS.csv -o DIR --jobs 2
    python -m benchmarks.prompts mosaic DIR -o all.jpg
    python -m benchmarks.prompts score GRADES.csv

`public` draws prompts from published files, `sheet` draws film strips for a grader, `mosaic` makes
one small image of a sheet, and `score` sums a grader's table.
"""
