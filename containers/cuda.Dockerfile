# texvent with torch and Triton for an NVIDIA GPU. From the root of the repository:
#   docker build -f containers/cuda.Dockerfile -t texvent-cuda .
#   docker run --rm --gpus all -v texvent-cache:/cache -v "$PWD:/work" texvent-cuda simulate clip.mp4 --interpolate rife -o clip.h5
# The host needs NVIDIA's driver and container toolkit. CUDA's libraries come with torch's wheels.
FROM python:3.13-slim-trixie@sha256:9d2e5553305c7c7b0097999bb17187c69b921ccd6bc9d40e4bb5ebe652c00285 AS build
WORKDIR /source
COPY pyproject.toml README.md LICENSE constraints.txt ./
COPY requirements requirements
COPY src src
ARG EXTRAS="gpu,rife"
ENV PIP_DISABLE_PIP_VERSION_CHECK=1
# By hash: what builds the wheel, and what every run imports. Extras come by version.
RUN pip install --no-cache-dir --require-hashes -r requirements/build.txt \
    && pip wheel --no-deps --no-build-isolation -w /wheels . \
    && python -m venv /opt/texvent \
    && /opt/texvent/bin/pip install --no-cache-dir --no-compile --require-hashes -r requirements/base.txt \
    && /opt/texvent/bin/pip install --no-cache-dir --no-compile -c constraints.txt "$(echo /wheels/*.whl)${EXTRAS:+[$EXTRAS]}"

FROM python:3.13-slim-trixie@sha256:9d2e5553305c7c7b0097999bb17187c69b921ccd6bc9d40e4bb5ebe652c00285
# Triton builds a small module in C for each kernel that it launches.
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --no-install-recommends -y gcc libc6-dev \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --create-home --uid 1000 texvent \
    && install -d -o texvent -g texvent /cache /work
COPY --from=build /opt/texvent /opt/texvent
ENV PATH=/opt/texvent/bin:$PATH NUMBA_CACHE_DIR=/cache/kernels TRITON_CACHE_DIR=/cache/triton \
    TEXVENT_CACHE=/cache/texvent XDG_CACHE_HOME=/cache \
    NVIDIA_VISIBLE_DEVICES=all NVIDIA_DRIVER_CAPABILITIES=compute,utility
USER 1000
WORKDIR /work
VOLUME /cache
ENTRYPOINT ["texvent"]
CMD ["doctor"]
