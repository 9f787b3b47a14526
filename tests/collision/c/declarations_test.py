#!/usr/bin/env python3
"""Checks what tools that make bindings read in the C header: by Clang's own tree of its declarations.

Every struct and every enumeration has a name, and its typedef has the same one. Members have plain types of a known
width, and no bit fields. Every name begins with surehit_, and every function has a comment.
"""

import json
import subprocess
import sys

clang, folder = sys.argv[1:3]
plain = {"float", "double", "size_t", "uint8_t", "uint32_t", "uint64_t", "int32_t", "void"}
done = subprocess.run([clang, "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fparse-all-comments",
                       "-fsyntax-only", "-Xclang", "-ast-dump=json", f"-I{folder}", "-x", "c", "-"],
                      input="#include <surehit/surehit.h>\n", capture_output=True, text=True)
if done.returncode != 0 or done.stderr:
    sys.exit(done.stderr)

file = ""
errors = []
found = {"RecordDecl": {}, "EnumDecl": {}, "TypedefDecl": {}, "FunctionDecl": {}}


def file_of(place):
    """The file of a declaration. Clang names it only where it differs from the one before."""
    global file
    for inner in (place, place.get("spellingLoc", {}), place.get("expansionLoc", {})):
        file = inner.get("file", file)
    return file


def children(node, kind):
    return [child for child in node.get("inner", []) if child.get("kind") == kind]


def expect(holds, node, what):
    if not holds:
        errors.append(f"{node.get('kind')} {node.get('name', '(no name)')}: {what}")


def is_plain(type_name):
    words = type_name.replace("*", " ").replace("const", " ").split()
    return all(word in plain or word.startswith("surehit_") or word == "char" for word in words)


for node in json.loads(done.stdout)["inner"]:
    if "surehit/" not in file_of(node.get("loc", {})):
        continue
    kind, name = node["kind"], node.get("name", "")
    expect(kind in found, node, "a declaration of this kind is a surprise")
    expect(name.startswith("surehit_"), node, "its name does not begin with surehit_")
    if kind not in found:
        continue
    if "inner" in node or kind == "TypedefDecl" or name not in found[kind]:
        found[kind][name] = node

for name, record in found["RecordDecl"].items():
    expect(record["tagUsed"] == "struct", record, "it is no struct")
    for field in record.get("inner", []):
        if field["kind"] == "FullComment":
            continue
        expect(field["kind"] == "FieldDecl", field, f"{name} has a part that is no member")
        if field["kind"] != "FieldDecl":
            continue
        expect("name" in field, field, f"{name} has a member without a name")
        expect(not field.get("isBitfield"), field, f"{name} has a bit field")
        type_name = field["type"]["qualType"]
        expect(is_plain(type_name) and "[" not in type_name, field, f"{name} has a member of type {type_name}")
        enumeration = type_name in found["EnumDecl"]
        expect(not enumeration, field, f"{name} has a member of an enumeration, whose width is not fixed")
        expect(children(field, "FullComment"), field, f"this member of {name} has no comment")

for kind in ("RecordDecl", "EnumDecl"):
    for name, node in found[kind].items():
        expect(name in found["TypedefDecl"], node, "there is no typedef of its name")

for name, node in found["EnumDecl"].items():
    for constant in children(node, "EnumConstantDecl"):
        expect(constant["name"].startswith("SUREHIT_"), constant, "its name does not begin with SUREHIT_")
        expect(children(constant, "FullComment"), constant, "it has no comment")
        expect(children(constant, "ConstantExpr"), constant, "it has no value of its own")

for name, node in found["FunctionDecl"].items():
    expect(children(node, "FullComment"), node, "it has no comment")
    expect(not node.get("inline") and not node.get("variadic"), node, "other languages cannot call it")
    for parameter in children(node, "ParmVarDecl"):
        expect("name" in parameter, node, "a parameter has no name")
        expect(is_plain(parameter["type"]["qualType"]), node, f"a parameter is of type {parameter['type']['qualType']}")

counts = {kind: len(nodes) for kind, nodes in found.items()}
print(counts)
if counts["FunctionDecl"] < 100 or counts["RecordDecl"] < 30:
    errors.append("Clang shows fewer declarations than there are")
sys.exit("\n".join(errors) or 0)
