"""The two directions of docs/architecture.md, and the sizes that keep a file readable."""
import re
import statistics
import subprocess

import pytest

from conftest import ROOT

# a folder may include those before it; `sim` and `io` stand beside and may use all of core
ORDER = ["base", "scan", "cloud", "detect", "match", "map", "assess"]
BESIDE = ["sim", "io", "calib"]
OF_ROS = re.compile(r"#include [<\"](ros|std_msgs|sensor_msgs|geometry_msgs|nav_msgs|nodelet|tf2\w*|cv_bridge|pcl_ros|field_fusion/ros)/")


def sources(*folders):
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", *folders], cwd=ROOT, text=True,
                            check=True, stdout=subprocess.PIPE).stdout.split()
    return [ROOT / name for name in listed if name.endswith((".h", ".cpp", ".py"))]


def core_files():
    return sources("include/field_fusion/core", "src/core")


def test_core_folders_include_only_those_before_them():
    wrong = []
    for file in core_files():
        folder = file.parent.name
        for included in re.findall(r'#include "field_fusion/core/(\w+)/', file.read_text()):
            if folder in ORDER and (included in BESIDE or ORDER.index(included) > ORDER.index(folder)):
                wrong.append(f"{file.relative_to(ROOT)} includes core/{included}")
    assert core_files() and not wrong


def test_core_includes_no_header_of_ros():
    assert [f for f in core_files() if OF_ROS.search(f.read_text())] == []


def test_ros_layer_does_not_know_the_nodelets():
    layer = sources("include/field_fusion/ros", "src/ros")
    assert layer and [f for f in layer if "nodelets/" in f.read_text()] == []


@pytest.mark.parametrize("folders, most", [(("src/nodelets",), 59), (("include", "src", "bench", "test", "scripts", "models"), 300)])
def test_files_stay_short(folders, most):
    lengths = {f: len(f.read_text().splitlines()) for f in sources(*folders)}
    assert lengths and {str(f.relative_to(ROOT)): n for f, n in lengths.items() if n > most} == {}


def test_half_of_the_files_are_below_120_lines():
    assert statistics.median(len(f.read_text().splitlines()) for f in sources("include", "src")) < 120
