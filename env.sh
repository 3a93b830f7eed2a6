unset PYTHONDONTWRITEBYTECODE
export PYTHONPATH=/tmp/s63/m/.dist:/tmp/s63/m/src:/tmp/s63/m/lab/src:/tmp/s63/m
export PATH=/work/main/.venv/bin:$PATH OMP_NUM_THREADS=1
