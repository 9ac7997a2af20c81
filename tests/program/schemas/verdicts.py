"""Prints which of the documents are valid by a schema: reads [schema's file, [document, ...]] from
standard input.
"""
import json
import sys

import jsonschema_rs

schema, documents = json.load(sys.stdin)
validator = jsonschema_rs.validator_for(json.load(open(schema, encoding="utf-8")))
print(json.dumps([validator.is_valid(document) for document in documents]))
