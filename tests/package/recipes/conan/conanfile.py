"""Makes a Conan package of the sources that this file is part of."""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.0"


class SurehitConan(ConanFile):
    name = "surehit"
    description = "Exact first contact of straight paths with triangle meshes"
    license = "MIT"
    topics = ("collision-detection", "ray-casting", "exact-arithmetic", "geometry", "games")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    @property
    def _sources_here(self):
        return os.path.join(self.recipe_folder, "..", "..", "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._sources_here, "collision/include/surehit/c/version.h"))
        self.version = ".".join(re.findall(r"#define SUREHIT_VERSION_\w+ (\d+)", header))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "broadphase/*", "collision/*"):
            copy(self, pattern, src=self._sources_here, dst=self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)
        self.requires("highway/1.2.0")

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SUREHIT_BUILD_TESTS"] = False
        toolchain.cache_variables["SUREHIT_BUILD_EXAMPLES"] = False
        toolchain.cache_variables["SUREHIT_GPU"] = False
        toolchain.cache_variables["SUREHIT_INSTALL"] = True
        toolchain.cache_variables["SUREHIT_WARNINGS_AS_ERRORS"] = False
        toolchain.cache_variables["CMAKE_DISABLE_FIND_PACKAGE_Doxygen"] = True
        toolchain.generate()
        deps = CMakeDeps(self)
        deps.set_property("highway", "cmake_file_name", "hwy")
        deps.set_property("highway::hwy", "cmake_target_name", "hwy::hwy")
        deps.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))
        rmdir(self, os.path.join(self.package_folder, "share"))

    def package_info(self):
        self.cpp_info.libs = ["surehit"]
        self.cpp_info.set_property("cmake_file_name", "surehit")
        self.cpp_info.set_property("cmake_target_name", "surehit::surehit")
        self.cpp_info.set_property("pkg_config_name", "surehit")
        if self.options.shared:
            self.cpp_info.defines = ["SUREHIT_SHARED"]
