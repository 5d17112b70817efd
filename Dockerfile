# mudline from a wheel: `make build`, then `docker build -t mudline .` and
# `docker run --rm -v "$PWD/decks:/decks:ro" mudline lint .`
FROM python:3.13-slim

RUN --mount=type=bind,source=dist,target=/dist \
    python -m pip install --no-cache-dir --disable-pip-version-check --root-user-action=ignore /dist/mudline-*.whl

RUN useradd --create-home --uid 1000 mudline
USER mudline
WORKDIR /decks
ENTRYPOINT ["mudline"]
CMD ["--help"]
