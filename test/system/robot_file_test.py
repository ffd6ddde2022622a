"""A robot's parameter file whose top level is misspelt."""
import subprocess

import pytest

from conftest import ROOT
from ros_session import RosSession

SHIPPED = sorted((ROOT / "config/robots").glob("*.yaml"))


def check(file, *command):
    return subprocess.run(["rosrun", "field_fusion", "check_robot", str(file), *command], text=True, timeout=60,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def robot_file(folder, text):
    file = folder / "robot.yaml"
    file.write_text(text)
    return file


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: file.stem)
def test_shipped_files_name_stages(file):
    done = check(file)
    assert (done.returncode, done.stdout) == (0, "")


def test_misspelt_stages_are_all_named(tmp_path):
    done = check(robot_file(tmp_path, "clutser:\n  epsilon: 0.5\nfilter: 3\nground:\n"))
    assert done.returncode == 1
    assert "clutser is not a stage" in done.stdout and "filter holds no parameters" in done.stdout
    assert "ground" not in done.stdout.split("stages:")[0]


@pytest.mark.parametrize("text", ["[1, 2]", "filter: {min_range: 1", "just words"])
def test_file_that_is_no_table_is_refused(tmp_path, text):
    assert check(robot_file(tmp_path, text)).returncode == 1


def test_missing_file_is_refused(tmp_path):
    assert check(tmp_path / "nowhere.yaml").returncode == 1


def test_good_file_becomes_the_command_with_its_arguments(tmp_path):
    done = check(robot_file(tmp_path, ""), "bash", "-c", 'echo "$1"; exit 7', "bash", "two words")
    assert (done.returncode, done.stdout) == (7, "two words\n")


def test_launch_ends_where_the_file_is_misspelt(tmp_path):
    file = robot_file(tmp_path, "clutser:\n  epsilon: 0.5\n")
    with RosSession() as session:
        launch = session.launch("field_fusion", "usv.launch", "rviz:=false", f"robot:={file}")
        assert session.wait(lambda: launch.poll() is not None)
        assert "clutser is not a stage" in session.running[-1][1].read_text()
