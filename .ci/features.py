#!/usr/bin/env python3
"""Prints the combinations of this crate's features, one a line, but none that names a feature which another one implies.

usage: features.py supported|unsupported|without-std

supported: those with `std` or `libm`, which must compile. unsupported: the others, which must not.
without-std: the one line of all features but `std`.
"""

import itertools
import json
import subprocess
import sys

metadata = json.loads(subprocess.check_output(["cargo", "metadata", "--format-version=1", "--no-deps"]))
declared = metadata["packages"][0]["features"]
features = sorted(declared.keys() - {"default"})


def implied(feature):
    """What enabling the feature enables besides."""
    direct = {other for other in declared[feature] if other in declared}
    return direct.union(*map(implied, direct))


def powerset():
    for size in range(len(features) + 1):
        for combination in itertools.combinations(features, size):
            if not set().union(*map(implied, combination)) & set(combination):
                yield combination


match sys.argv[1:]:
    case ["without-std"]:
        print(",".join(feature for feature in features if feature != "std"))
    case ["supported" | "unsupported" as which]:
        for combination in powerset():
            if ({"std", "libm"} & set(combination) != set()) == (which == "supported"):
                print(",".join(combination))
    case _:
        sys.exit(__doc__)
