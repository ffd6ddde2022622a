"""A test site ashore, as the surface vessel's paper (001, section VII) has one: models of cages stood on their nets
before hedges and walls. Worlds to learn from alone have it, so that `val` and `held_out` stay what they were."""
import math

from data import afloat, bodies
from data.thing import Thing

SHARE = 0.4  # of the worlds ashore
MODELS = (0.35, 1.5)  # m, diameter of a cage that one can carry there


def model_cage(draw):
    thing = afloat.cage(draw, MODELS)
    thing.label = "cage"
    return thing


def hedge(scene):
    """Round bushes in a row."""
    draw = scene.draw
    size, angle, away = draw.number(0.8, 2.2), draw.uniform(-0.6, 0.6), draw.spread(6, 30)
    turn, gap = angle + draw.uniform(-0.6, 0.6), draw.number(1.05, 2.0)
    params = {"diameter": size, "height": draw.near(0.85 * size)}
    for i in range(draw.randint(3, 10)):
        along = (i - 4) * gap * size
        x, y = away * math.cos(angle) - along * math.sin(turn), away * math.sin(angle) + along * math.cos(turn)
        if scene.free(x, y, size / 2):
            scene.take([(x, y, size / 2)])
            scene.add_anyhow(Thing({"shape": "bush", "params": dict(params)}, size / 2, size), x, y, 0)


def put_site(scene):
    draw = scene.draw
    for _ in range(draw.randint(1, 5)):
        scene.try_in_view(model_cage(draw))
    for _ in range(draw.randint(0, 2)):
        scene.try_in_view(bodies.fixture(draw))
    if draw.chance(0.7):
        hedge(scene)
