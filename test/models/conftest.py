import os
import pathlib
import sys

os.environ["OMP_WAIT_POLICY"] = "PASSIVE"  # before torch: its threads would else spin, which a busy machine makes slow

import pytest  # noqa: E402
import torch  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "models"), str(pathlib.Path(__file__).parent)]
torch.set_num_threads(2)


@pytest.fixture(scope="session")
def shapes_folder(tmp_path_factory):
    """A small data set of coloured shapes."""
    from shapes import write_dataset

    return write_dataset(tmp_path_factory.mktemp("shapes"), {"train": 16, "val": 8}, (96, 64))
