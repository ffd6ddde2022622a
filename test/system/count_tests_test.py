"""The line that closes scripts/test."""
from count_tests import count


def write(folder, name, body):
    (folder / name).write_text(f"<testsuite>{body}</testsuite>")


def test_outcomes_are_summed_over_files(tmp_path):
    write(tmp_path, "a.xml", '<testcase classname="A" name="ok"/><testcase name="x"><failure/></testcase>')
    write(tmp_path, "b.xml", '<testcase name="s"><skipped/></testcase><testcase name="e"><error/></testcase>')
    counts, failed = count(tmp_path)
    assert counts == {"passed": 1, "failed": 2, "skipped": 1}
    assert len(failed) == 2


def test_truncated_result_counts_as_failed(tmp_path):
    (tmp_path / "a.xml").write_text("<testsuite><testcase")
    assert count(tmp_path)[0] == {"passed": 0, "failed": 1, "skipped": 0}


def test_no_test_at_all_is_seen(tmp_path):
    assert count(tmp_path)[0] == {"passed": 0, "failed": 0, "skipped": 0}
