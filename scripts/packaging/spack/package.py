# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spack: copy into packages/sunload of a repository of yours; `spack dev-build sunload@main` in the sources."""

from spack.package import *


class Sunload(CMakePackage):
    """Sun and sky light on every patch of a city: time series with standard errors, from YAML studies."""

    license("GPL-3.0-or-later")
    version("main", branch="main")

    variant("mpi", default=True, description="Share work among MPI ranks")

    depends_on("cxx", type="build")
    depends_on("cmake@3.23:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("embree@3.13:3")
    depends_on("cgal@5.5:5")
    depends_on("eigen@3.4:")
    depends_on("geographiclib@2.1:")
    depends_on("erfa")
    depends_on("proj@9:")
    depends_on("hdf5@1.10: +hl")
    depends_on("yaml-cpp@0.7:")
    depends_on("nlohmann-json@3.11:")
    depends_on("cli11@2.1:")
    depends_on("fmt@9")
    depends_on("openssl@3:")
    depends_on("boost")
    depends_on("imath@3:")
    depends_on("coin3d@4:")
    depends_on("gdal@3.6:")
    depends_on("libdeflate")
    depends_on("pugixml@1.11:")
    depends_on("cairo +png")
    depends_on("howard-hinnant-date +tzdb")
    depends_on("random123")
    depends_on("mpi", when="+mpi")

    def cmake_args(self):
        return [self.define_from_variant("SUNLOAD_MPI", "mpi"), self.define("SUNLOAD_BUILD_TESTS", False)]
