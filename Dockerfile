# tcm-icp in a container, from the packages that scripts/make_packages.sh makes:
#   scripts/make_packages.sh && docker build -t tcm-icp .
#   docker run --rm -u "$(id -u):$(id -g)" -v "$PWD:/work" tcm-icp register datasets/town --out out/town
FROM debian:bookworm-slim
COPY build/packages/packages/libtcm-icp0.1_*.deb build/packages/packages/tcm-icp_*.deb build/packages/packages/python3-tcm-icp_*.deb /tmp/packages/
RUN apt-get update \
    && apt-get install --yes --no-install-recommends /tmp/packages/*.deb \
    && rm -rf /tmp/packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["tcm-icp"]
CMD ["--help"]
