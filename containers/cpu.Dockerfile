# texvent on the CPU, with the extras of an argument. From the root of the repository:
#   docker build -f containers/cpu.Dockerfile -t texvent .
#   docker run --rm -v texvent-cache:/cache -v "$PWD:/work" texvent generate "a dog runs" -o dog.h5
FROM python:3.13-slim-trixie@sha256:9d2e5553305c7c7b0097999bb17187c69b921ccd6bc9d40e4bb5ebe652c00285 AS build
WORKDIR /source
COPY pyproject.toml README.md LICENSE constraints.txt ./
COPY requirements requirements
COPY src src
# Extras separated by commas, such as bags,zstd.
ARG EXTRAS=""
ENV PIP_DISABLE_PIP_VERSION_CHECK=1
# By hash: what builds the wheel, and what every run imports. Extras come by version.
RUN pip install --no-cache-dir --require-hashes -r requirements/build.txt \
    && pip wheel --no-deps --no-build-isolation -w /wheels . \
    && python -m venv /opt/texvent \
    && /opt/texvent/bin/pip install --no-cache-dir --no-compile --require-hashes -r requirements/base.txt \
    && /opt/texvent/bin/pip install --no-cache-dir --no-compile -c constraints.txt "$(echo /wheels/*.whl)${EXTRAS:+[$EXTRAS]}"

FROM python:3.13-slim-trixie@sha256:9d2e5553305c7c7b0097999bb17187c69b921ccd6bc9d40e4bb5ebe652c00285
RUN useradd --create-home --uid 1000 texvent \
    && install -d -o texvent -g texvent /cache /work
COPY --from=build /opt/texvent /opt/texvent
# Kernels are compiled at the first run, weights and recordings are fetched by name: both stay in the volume.
ENV PATH=/opt/texvent/bin:$PATH NUMBA_CACHE_DIR=/cache/kernels TEXVENT_CACHE=/cache/texvent XDG_CACHE_HOME=/cache
USER 1000
WORKDIR /work
VOLUME /cache
ENTRYPOINT ["texvent"]
CMD ["doctor"]
