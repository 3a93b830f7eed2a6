"""How fast texvent is: kernels, the whole pipeline by stage, peers, start-up, memory, GPU.

    python -m texvent_lab.measure.speed [--quick] [--json FILE]

`docs/speed.md` says what is measured and shows the committed figures;
`docs/results/speed.schema.json` describes the JSON.
"""
