"""Both ways to build: the workspace that comes with the package, and a workspace of its user.

The first is built whole before; of the second the nodelets and one program, as the rest is built alike."""
import os
import pathlib
import shutil
import subprocess

import pytest

from conftest import ROOT
from ros_session import RosSession

SCRATCH = os.environ.get("FIELD_FUSION_SCRATCH")
pytestmark = pytest.mark.skipif(not SCRATCH, reason="run by scripts/test, which names a scratch folder")


def shell(script, **kwargs):
    return subprocess.run(["bash", "-c", script], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **kwargs)


def copy_of_checkout(target):
    """What a clone would hold: tracked files, and new ones that git does not ignore."""
    files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, text=True, check=True,
                           stdout=subprocess.PIPE).stdout.split("\n")
    for name in filter(lambda n: n and (ROOT / n).is_file(), files):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, target / name)


@pytest.fixture(scope="module")
def user_workspace():
    workspace = pathlib.Path(SCRATCH) / "user_ws"
    copy_of_checkout(workspace / "src" / "field_fusion")
    build = shell(f". {ROOT}/scripts/environment; cd {workspace}; "
                  "catkin_make -j$JOBS -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_ENABLE_TESTING=OFF field_fusion_nodelets kitti_to_bag")
    assert build.returncode == 0, build.stdout[-4000:]
    return workspace


def in_workspace(workspace, command):
    return shell(f". {ROOT}/scripts/environment; set +u; . {workspace}/devel/setup.bash; {command}")


def assert_found_by_name(workspace):
    files = in_workspace(workspace, "roslaunch --files field_fusion usv.launch")
    assert files.returncode == 0, files.stdout
    assert "filter.launch" in files.stdout
    tool = in_workspace(workspace, "rosrun field_fusion kitti_to_bag --help")
    assert tool.returncode == 0, tool.stdout
    plugins = in_workspace(workspace, "rospack plugins --attrib=plugin nodelet")
    assert "field_fusion" in plugins.stdout


def test_own_workspace_finds_launch_files_tools_and_nodelets(user_workspace):
    assert_found_by_name(user_workspace)


def test_workspace_of_the_package_finds_them_too():
    assert_found_by_name(ROOT / "catkin_ws")


def test_user_workspace_lists_the_package_once(user_workspace):
    listed = in_workspace(user_workspace, "rospack list-names | grep -c '^field_fusion$'")
    assert listed.stdout.strip() == "1"


def test_stage_loads_from_the_user_workspace(user_workspace):
    # a parameter that does not exist: the plug-in was found and loaded when it complains about that
    with RosSession():
        refused = in_workspace(user_workspace, "timeout 20 rosrun nodelet nodelet standalone field_fusion/filter _typo:=1")
    assert "typo is not a parameter of this stage" in refused.stdout, refused.stdout
