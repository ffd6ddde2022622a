"""Which worlds of a data set are still to be filmed."""
import pytest

import make_dataset
from data import random_world

FRAMES = random_world.FRAMES


def film(out, name, split, _, frames):
    for kind, ending in (("images", "jpg"), ("labels", "txt")):
        (out / kind / split).mkdir(parents=True, exist_ok=True)
        for i in range(frames):
            (out / kind / split / f"{name}_{i:06d}.{ending}").touch()
    (out / "worlds").mkdir(exist_ok=True)
    (out / "worlds" / f"{name}.yaml").touch()


def test_as_many_pictures_as_asked_for(tmp_path):
    jobs = make_dataset.jobs_of(tmp_path, "train", 2 * FRAMES + 1, 1)
    assert [job[3] for job in jobs] == [FRAMES, FRAMES, 1] and len({job[:3] for job in jobs}) == 3


def test_only_what_is_missing_is_made(tmp_path):
    jobs = make_dataset.jobs_of(tmp_path, "train", 3 * FRAMES, 1)
    film(tmp_path, *jobs[0])
    assert make_dataset.jobs_of(tmp_path, "train", 3 * FRAMES, 1) == jobs[1:]
    (tmp_path / "images/train" / f"{jobs[0][0]}_000001.jpg").unlink()
    assert make_dataset.jobs_of(tmp_path, "train", 3 * FRAMES, 1) == jobs


def test_a_world_of_which_fewer_pictures_were_asked_for_is_filmed_whole(tmp_path):
    for job in make_dataset.jobs_of(tmp_path, "train", FRAMES + 1, 1):
        film(tmp_path, *job)
    assert [job[3] for job in make_dataset.jobs_of(tmp_path, "train", 2 * FRAMES, 1)] == [FRAMES]


@pytest.mark.parametrize("text, words", [("- a\n", "is not of make_dataset"), ("names: [a]\n", "is not of make_dataset"),
                                         ("a: [", "is not of make_dataset"), ("seed: 2\n", "is of another seed")])
def test_a_folder_of_others_is_refused(tmp_path, text, words):
    (tmp_path / "data.yaml").write_text(text)
    with pytest.raises(RuntimeError, match=words):
        make_dataset.check_seed(tmp_path, 1)
