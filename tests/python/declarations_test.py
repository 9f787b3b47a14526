"""The package declares the functions, structs and constants of the C header as they are there."""

import ctypes
import os
import re
import unittest
import unittest.mock
from pathlib import Path

from surehit import _layouts, _library

HEADERS = Path(os.environ["SUREHIT_SOURCE_FOLDER"]) / "collision/include/surehit"
TEXT = "\n".join(path.read_text() for path in sorted((HEADERS / "c").glob("*.h")))
TEXT = re.sub(r"//.*", "", TEXT)

PLAIN = {"float": ctypes.c_float, "double": ctypes.c_double, "size_t": ctypes.c_size_t, "uint8_t": ctypes.c_uint8,
         "uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64}


def members_of(name):
    """Returns the names and types of a struct's members in C."""
    body = re.search(rf"typedef struct surehit_{name} {{(.*?)}}", TEXT, re.DOTALL)[1]
    members = [" ".join(member.split()) for member in body.split(";")]
    return [(member.rpartition(" ")[2].lstrip("*"), member.rpartition(" ")[0]) for member in members if member]


def size_and_alignment_of(type_name):
    """Returns the size and the alignment of a type in C."""
    if "*" in type_name or type_name.startswith(("surehit_run_tasks", "surehit_accept", "surehit_tell")):
        return (ctypes.sizeof(ctypes.c_void_p),) * 2
    if type_name in PLAIN:
        return (ctypes.sizeof(PLAIN[type_name]),) * 2
    end = largest = 0
    for _, member_type in members_of(type_name.removeprefix("surehit_")):
        size, alignment = size_and_alignment_of(member_type)
        end = -(-end // alignment) * alignment + size
        largest = max(largest, alignment)
    return -(-end // largest) * largest, largest


def size_of(type_name):
    """Returns the size of a type in C."""
    return size_and_alignment_of(type_name)[0]


class DeclarationsTest(unittest.TestCase):
    def test_functions_have_as_many_arguments(self):
        declared = re.findall(r"SUREHIT_C_API\s+[\w\s*]+?\bsurehit_(\w+)\(([^)]*)\)", TEXT)
        self.assertGreater(len(declared), 100)
        checked = 0
        for name, parameters in declared:
            function = getattr(_library.LIBRARY, "surehit_" + name)
            if function.argtypes is None:
                continue
            checked += 1
            wanted = [" ".join(parameter.split()) for parameter in parameters.split(",")]
            with self.subTest(function=name):
                self.assertEqual(len(wanted), len(function.argtypes))
                for parameter, given in zip(wanted, function.argtypes):
                    type_name = parameter.rpartition(" ")[0]
                    size = ctypes.sizeof(ctypes.c_void_p) if "*" in parameter else size_of(type_name)
                    self.assertEqual(size, ctypes.sizeof(given), parameter)
        self.assertGreater(checked, 100)

    def test_structs_have_the_same_members(self):
        for layouts in (_layouts.FLOAT, _layouts.DOUBLE):
            s = layouts.suffix
            structs = {"executor": _layouts.Executor, "statistics": _layouts.Statistics,
                       "build_options": _layouts.BuildOptions, "grid_summary": _layouts.GridSummaryStruct,
                       "instance_id": _layouts.InstanceIdStruct, "path" + s: layouts.Path, "paths" + s: layouts.Paths,
                       "mesh" + s: layouts.Mesh, "vector3" + s: layouts.Vector3Struct, "hit" + s: layouts.collider.Hit,
                       "query_options" + s: layouts.collider.Options, "filter" + s: layouts.collider.Filter,
                       "batch_options" + s: layouts.collider.BatchOptions, "scene_hit" + s: layouts.scene.Hit,
                       "scene_query_options" + s: layouts.scene.Options, "scene_filter" + s: layouts.scene.Filter,
                       "scene_batch_options" + s: layouts.scene.BatchOptions, "swept_shape" + s: layouts.Shape,
                       "swept_shapes" + s: layouts.Shapes, "shape_hit" + s: layouts.shape.Hit,
                       "shape_query_options" + s: layouts.shape.Options, "shape_filter" + s: layouts.shape.Filter,
                       "shape_batch_options" + s: layouts.shape.BatchOptions,
                       "scene_shape_hit" + s: layouts.scene_shape.Hit,
                       "scene_shape_query_options" + s: layouts.scene_shape.Options,
                       "scene_shape_filter" + s: layouts.scene_shape.Filter,
                       "scene_shape_batch_options" + s: layouts.scene_shape.BatchOptions,
                       "explained_cell": _layouts.ExplainedCellStruct, "filter_number": _layouts.FilterNumberStruct,
                       "explained_candidate": _layouts.ExplainedCandidateStruct,
                       "explained_hit" + s: layouts.ExplainedHit, "explainer" + s: layouts.Explainer}
            for name, struct in structs.items():
                with self.subTest(struct=name):
                    members = members_of(name)
                    self.assertEqual([member for member, _ in members], [field[0] for field in struct._fields_])
                    for (member, type_name), field in zip(members, struct._fields_):
                        self.assertEqual(size_of(type_name), ctypes.sizeof(field[1]), member)
            self.assertEqual(size_of("surehit_pose" + s), ctypes.sizeof(layouts.PoseStruct))

    def test_arrays_have_the_layouts_of_structs(self):
        for layouts in (_layouts.FLOAT, _layouts.DOUBLE):
            for kind in (layouts.collider, layouts.scene, layouts.shape, layouts.scene_shape):
                for dtype, struct in ((kind.hit_dtype, kind.Hit), (kind.options_dtype, kind.Options)):
                    self.assertEqual(dtype.itemsize, ctypes.sizeof(struct))
                    for name, *_ in struct._fields_:
                        self.assertEqual(dtype.fields[name][1], getattr(struct, name).offset)

    def test_constants(self):
        abi = int(re.search(r"#define SUREHIT_C_ABI (\d+)", TEXT)[1])
        version = ".".join(re.search(rf"#define SUREHIT_VERSION_{part} (\d+)", TEXT)[1] for part in ("MAJOR", "MINOR"))
        self.assertEqual((_library.C_ABI, _library.VERSION), (abi, version))
        with unittest.mock.patch.object(_library, "C_ABI", abi + 1), self.assertRaisesRegex(ImportError, "another ABI"):
            _library._load()
        for name, number in (("STOP", _layouts.STOP), ("REJECT", _layouts.REJECT), ("ACCEPT", _layouts.ACCEPT)):
            self.assertIn(f"SUREHIT_{name} = {number}", TEXT)


if __name__ == "__main__":
    unittest.main()
