"""scripts/install_dependencies names everything that the package uses: what it includes, finds, imports and calls."""
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT

INCLUDE_DIRS = ["/usr/include", "/usr/include/x86_64-linux-gnu", "/usr/include/eigen3", "/usr/include/opencv4",
                "/usr/include/pluginlib", *map(str, pathlib.Path("/usr/include").glob("pcl-*"))]
CONFIG_FILES = ["/usr/share/{0}/cmake/{0}Config.cmake", "/usr/lib/x86_64-linux-gnu/cmake/{0}/{0}Config.cmake"]
PROGRAMS = ["cmake", "ccache", "git", "g++", "make", "catkin_make", "rosrun", "roslaunch", "roscore", "rostest", "rosparam",
            "rosbag", "rospack", "rviz", "Xvfb", "check_urdf", "import", "pytest-3"]
DPKG = shutil.which("dpkg-query")
pytestmark = pytest.mark.skipif(not DPKG, reason="not a Debian machine")


def run(*command):
    return subprocess.run(command, text=True, capture_output=True).stdout


def sources(*patterns):
    files = run("git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard", *patterns).split("\n")
    return [ROOT / name for name in files if name and (ROOT / name).is_file()]


def included():
    """Headers of others: {"ros/ros.h": file that includes it}."""
    found = {}
    for file in sources("*.h", "*.cpp"):
        for name in re.findall(r"^\s*#include <([^>]+\.(?:h|hpp))>|^\s*#include <(Eigen/\w+)>", file.read_text(), re.M):
            found["".join(name)] = file
    optional = ("openvino/", "vision_msgs/", "octomap_msgs/")  # built without where they are missing
    return {name: file for name, file in found.items() if not name.startswith(optional)}


def imported():
    """Modules of others that the Python files import; our own messages and helpers left out."""
    own = {name for path in sources("*.py") for name in (path.stem, path.parent.name)} | {"field_fusion"}
    found = set()
    for file in [*sources("*.py"), *[f for f in sources("scripts/*") if f.read_bytes()[:30].startswith(b"#!/usr/bin/python3")]]:
        found |= set(re.findall(r"^\s*(?:import|from) (\w+)", file.read_text(), re.M))
    return {m for m in found - own if m not in sys.stdlib_module_names}


def owner(path):
    """Package of an installed file; links are followed, because alternatives belong to nobody."""
    for candidate in (path, str(pathlib.Path(path).resolve()), str(path).replace("/usr/lib/", "/lib/")):
        answer = run("dpkg", "-S", candidate)
        if answer:
            return answer.split(":")[0].split(",")[0]
    return None


@pytest.fixture(scope="module")
def installed_by_the_script():
    listed = run(str(ROOT / "scripts/install_dependencies"), "--list").split()
    closure = run("apt-cache", "depends", "--recurse", "--no-recommends", "--no-suggests", "--no-conflicts", "--no-breaks",
                  "--no-replaces", "--no-enhances", "--installed", *listed)
    return set(listed) | set(re.findall(r"^(\S+?)(?::\w+)?$", closure, re.M))


def test_every_included_header_comes_with_the_list(installed_by_the_script):
    missing = []
    for header, user in included().items():
        path = next((f"{d}/{header}" for d in INCLUDE_DIRS if pathlib.Path(d, header).exists()), None)
        if path is None or owner(path) not in installed_by_the_script:
            missing.append(f"{header} of {user.name}: in {path and owner(path)}")
    assert not missing


def test_every_python_module_comes_with_the_list(installed_by_the_script):
    missing = []
    for module in imported():
        spec = importlib.util.find_spec(module)
        if spec is None or owner(spec.origin) not in installed_by_the_script:
            missing.append(f"{module}: in {spec and owner(spec.origin)}")
    assert not missing


def test_every_catkin_component_comes_with_the_list(installed_by_the_script):
    text = (ROOT / "cmake/ros.cmake").read_text()
    components = re.search(r"COMPONENTS([^)]*)\)", text).group(1).split()

    def config(component):
        return next((f for f in (c.format(component) for c in CONFIG_FILES) if pathlib.Path(f).exists()), "/nonexistent")

    missing = [c for c in components if owner(config(c)) not in installed_by_the_script]
    assert components and not missing


@pytest.mark.parametrize("program", PROGRAMS)
def test_every_program_comes_with_the_list(program, installed_by_the_script):
    path = shutil.which(program, path="/usr/bin:/usr/sbin:/bin")
    assert path, f"{program} is not on this machine"
    assert owner(path) in installed_by_the_script, f"{program} is in {owner(path)}"
