"""What is started under a master of one's own ends with it."""
import os

import pytest
import ros_session
from ros_session import RosSession, SessionError


@pytest.fixture
def session(tmp_path, monkeypatch):
    for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_HOME"):
        monkeypatch.setenv(name, "")  # what the session sets goes with the test
    with RosSession(tmp_path) as session:
        yield session


def test_master_is_the_one_of_the_environment(session):
    assert os.environ["ROS_MASTER_URI"].endswith(f":{session.port}")
    assert session.wait(lambda: "/rosout_agg" in session.topic_types())


def test_all_that_was_started_ends(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "")
    monkeypatch.setattr(ros_session, "ASK", 1.0)
    with RosSession(tmp_path) as session:
        session.start("bash", "-c", "trap '' INT; while :; do sleep 1; done")
        started = [process for process, _ in session.running]
    assert len(started) == 2 and all(process.poll() is not None for process in started)


def test_two_sessions_live_side_by_side(session, tmp_path):
    (tmp_path / "other").mkdir()
    with RosSession(tmp_path / "other") as other:
        assert other.port != session.port
        other.start("rostopic", "pub", "/only_here", "std_msgs/Empty")
        assert other.wait(lambda: "/only_here" in other.topic_types())
        assert "/only_here" not in session.topic_types()


def test_end_of_a_needed_program_is_told_with_its_log(session):
    needed = session.start("bash", "-c", "echo no sensor here; exit 3")
    with pytest.raises(SessionError, match="(?s)nothing came.*it ended.*no sensor here"):
        session.require(lambda: False, 30.0, "nothing came", needed)


def test_end_of_a_launched_node_is_told_at_once_though_the_rest_runs_on(session, tmp_path):
    launch = tmp_path / "a.launch"
    launch.write_text("""<launch>
      <node pkg="rostopic" type="rostopic" name="lasting" args="echo /nothing"/>
      <node pkg="rostopic" type="rostopic" name="failing" args="no_such_command" output="screen"/>
    </launch>""")
    with pytest.raises(SessionError, match="(?s)nothing came.*it ended.*failing"):
        session.require(lambda: False, 60.0, "nothing came", session.launch(launch))


def test_wait_tells_when_time_is_up(session):
    assert not session.wait(lambda: False, 0.05)
    assert session.wait(lambda: True, 0.0)
