#!/usr/bin/env python3
"""Sums the JUnit files below a folder into one line; fails when a test failed, or none ran."""
import pathlib
import sys
import xml.etree.ElementTree as ET


def outcome(case):
    if case.find("failure") is not None or case.find("error") is not None:
        return "failed"
    if case.find("skipped") is not None or case.get("status") == "notrun":
        return "skipped"
    return "passed"


def count(folder):
    """Counts by outcome, and the names of the failed tests. A file that cannot be read is a failure."""
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    failed = []
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        try:
            cases = list(ET.parse(path).iter("testcase"))
        except ET.ParseError as error:
            counts["failed"] += 1
            failed.append(f"{path.name}: {error}")
            continue
        for case in cases:
            result = outcome(case)
            counts[result] += 1
            if result == "failed":
                failed.append(f"{case.get('classname')}.{case.get('name')}")
    return counts, failed


def main():
    counts, failed = count(sys.argv[1])
    for name in failed:
        print("FAILED", name)
    print("{passed} passed, {failed} failed, {skipped} skipped".format(**counts))
    return 1 if counts["failed"] or not counts["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
