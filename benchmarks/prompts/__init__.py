"""How well the embedded generator shows what prompts say.

    python -m benchmarks.prompts public --vbench F --moviegen F --coco F -o DIR
    python -m benchmarks.prompts sheet PROMPTS.csv -o DIR --jobs 2
    python -m benchmarks.prompts views PROMPTS.csv
    python -m benchmarks.prompts mosaic DIR -o all.jpg
    python -m benchmarks.prompts score GRADES.csv
    python -m benchmarks.prompts coverage
    python -m benchmarks.prompts structure GOLD.json

`public` draws prompts from published files, `sheet` draws what a grader judges, `views` counts what
is named and not in view, `mosaic` makes one small image of a sheet, `score` sums a grader's table,
`coverage` counts which names of COCO and ImageNet are shown, and `structure` compares what is read
with annotated sentences.
"""
