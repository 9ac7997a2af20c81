"""Validates documents against their schemas by the package jsonschema-rs, and shows what the schemas
leave open.

Reads a list of [schema's file, document's file] from standard input. A document that its schema
refuses ends it with status 1. Prints, for each schema, the changes of its documents that it does not
refuse: a field dropped, a field renamed, a value of another type in its place; a path has [] for any
place in a list, N for any number in a name and V for any variant. Documents of more than 300 kB
are not changed.
"""
import json
import random
import re
import sys

import jsonschema_rs

OTHERS = ["words", -0.5, True, {"x": 1}, [[[]]]]


def kind(value):
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return "number" if number else type(value).__name__


def free(name):
    """Returns a name without what is free in it."""
    name = re.sub("^(printed|tied|stepped|unilateral)$", "V", name)
    return re.sub("[0-9]+", "N", name)


def places(value, path, found):
    """Collects the places of a document by their paths: container and key or index."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, item in items:
        name = "[]" if isinstance(value, list) else "/" + free(key)
        here = path + name
        found.setdefault(here, []).append((value, key))
        if isinstance(item, (dict, list)):
            places(item, here, found)


def changes(container, key):
    """Makes each change of a place in turn, by its name; the document is as it was in the end."""
    value = container[key]
    if isinstance(container, dict):
        was = dict(container)
        del container[key]
        yield "dropped"
        container[key + " again"] = value
        yield "renamed"
        container.clear()
        container.update(was)
    for other in OTHERS:
        if kind(other) != kind(value):
            container[key] = other
            yield "of another type"
    container[key] = value


def accepted(validator, document, chance):
    found = {}
    places(document, "", found)
    for path, those in found.items():
        container, key = chance.choice(those)
        for change in changes(container, key):
            if validator.is_valid(document):
                yield path, change


refused, left_open, validators = False, {}, {}
for schema, file in json.load(sys.stdin):
    if schema not in validators:
        text = json.load(open(schema, encoding="utf-8"))
        jsonschema_rs.meta.validate(text)
        validators[schema] = jsonschema_rs.validator_for(text)
    text = open(file, encoding="utf-8").read()
    document = json.loads(text)
    for error in validators[schema].iter_errors(document):
        refused = True
        print(f"{file} by {schema}: {error.instance_path}: {error.message}"[:600], file=sys.stderr)
    found = left_open.setdefault(schema, set())
    if len(text) < 300_000:
        found.update(accepted(validators[schema], document, random.Random(1)))
    assert document == json.loads(text), "the changes were undone"
for schema, found in sorted(left_open.items()):
    for path, change in sorted(found):
        print(f"{schema} {path} {change}")
sys.exit(refused)
