unset PYTHONDONTWRITEBYTECODE
export PYTHONPATH=/work/wt/last/.dist:/work/wt/last/src:/work/wt/last/lab/src:/work/wt/last
export PATH=/work/main/.venv/bin:$PATH OMP_NUM_THREADS=1
