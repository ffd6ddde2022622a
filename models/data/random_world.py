"""A random world to learn from."""
import pathlib

import yaml

from data import bodies, site, surroundings
from data.draw import Draw
from data.quay import put_quay
from data.scene import Scene

FRAMES = surroundings.FRAMES  # pictures of a world
PAUSE = surroundings.PAUSE  # s between them
AFLOAT = {"cage": 3, "boat": 3, "buoy": 3, "box": 0.3}
ON_LAND = {"car": 1.6, "balloon_car": 2.2, "puppet": 2.2, "person": 1.6, "box": 1.4, "cone": 1.8, "ball": 2,
           "stool": 2, "chair": 2, "bollard": 1.2, "boat": 0.5, "cage": 0.5, "buoy": 0.4}


def fill(scene, wet, empty):
    draw = scene.draw
    if wet and draw.chance(0.65):
        put_quay(scene, 0 if empty else draw.randint(4, 14))
    for _ in range(0 if empty else draw.randint(2, 10) if wet else draw.randint(4, 16)):
        thing = bodies.labelled(draw, draw.one_of(AFLOAT if wet else ON_LAND))
        scene.try_in_view(thing, **({"floats": True} if wet else {"leans": draw.chance(0.3)}))
    for _ in range(draw.randint(0, 3) if wet else draw.randint(1, 8)):
        scene.try_in_view(bodies.fixture(draw, wet))


def random_world(split, seed):
    """As a dictionary, ready to be written."""
    draw = Draw(split, seed)
    wet, empty = draw.chance(0.5), draw.chance(0.07)
    camera = surroundings.camera(draw, draw.chance(0.75))
    places, keys = surroundings.way(draw, wet)
    scene = Scene(draw, places, camera)
    if split == "train" and not (wet or empty) and draw.chance(site.SHARE):
        site.put_site(scene)
    fill(scene, wet, empty)
    ground = surroundings.water(draw) if wet else surroundings.land(draw)
    return {"name": f"{split}_{seed}", "ground": ground, "light": surroundings.light(draw), "bodies": scene.bodies,
            "robot": {"name": "robot", **keys, "mounts": [camera]}}


def write(file, split, seed):
    text = yaml.safe_dump(random_world(split, seed), sort_keys=False, default_flow_style=None, width=1000)
    pathlib.Path(file).write_text(text)
