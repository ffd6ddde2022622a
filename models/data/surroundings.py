"""Light, ground, camera and way of a random world."""
import math

FRAMES = 3  # pictures of a world
PAUSE = 2.0  # s between them
USV_CAMERA = {"model": "xfk_4k415", "width": 640, "height": 360, "fx": 245.5}
LAND = {"asphalt": [0.07, 0.07, 0.075], "concrete": [0.35, 0.34, 0.32], "grass": [0.06, 0.14, 0.03],
        "sand": [0.45, 0.36, 0.22], "earth": [0.14, 0.09, 0.05], "wood": [0.3, 0.18, 0.09], "lino": [0.3, 0.32, 0.34]}
WATER = ([0.02, 0.06, 0.09], [0.05, 0.12, 0.14], [0.04, 0.1, 0.06], [0.1, 0.09, 0.05], [0.06, 0.16, 0.2], [0.08, 0.1, 0.11])


# Cover of clouds, brightness of sun and sky, visibility [m]: from .. to.
SKIES = {
    "clear": ((0.0, 0.3), (0.8, 1.3), (0.15, 0.4), (3000, 15000)),
    "fair": ((0.35, 0.6), (0.5, 1.2), (0.2, 0.6), (2000, 10000)),
    "grey": ((0.75, 1.0), (0.02, 0.2), (0.2, 0.8), (800, 6000)),
    "dusk": ((0.3, 0.7), (0.05, 0.3), (0.03, 0.12), (1500, 6000)),
    "fog": ((0.8, 1.0), (0.02, 0.1), (0.3, 0.8), (90, 400)),
    "storm": ((0.62, 0.75), (0.1, 0.5), (0.08, 0.25), (600, 3000)),
}


def sky_colours(draw, sky):
    if sky == "dusk":
        return {"sun_colour": [1.0, draw.number(0.45, 0.7), draw.number(0.15, 0.4)],
                "zenith": draw.colour((0.45, 0.6), (0.4, 0.7), (0.6, 0.75)),
                "horizon": draw.colour((0.85, 1), (0.25, 0.6), (0.02, 0.1))}
    if sky in ("grey", "fog", "storm"):
        return {"zenith": draw.colour((0.55, 0.7), (0.05, 0.25), (0.5, 0.65)),
                "horizon": draw.colour((0.75, 0.95), (0, 0.12), (0.5, 0.65))}
    return {"sun_colour": [1.0, draw.number(0.85, 1.0), draw.number(0.6, 0.9)],
            "zenith": draw.colour((0.6, 0.95), (0.4, 0.65), (0.56, 0.63)),
            "horizon": draw.colour((0.9, 1), (0.03, 0.25), (0.52, 0.62))}


def light(draw):
    """Every eighth time the sun stands in the picture, low."""
    sky = draw.kind({"clear": 1, "fair": 2, "grey": 1.5}, {"dusk": 1, "fog": 0.7, "storm": 1})
    clouds, sun, brightness, visibility = SKIES[sky]
    glare = draw.chance(0.12) and sky not in ("grey", "fog")
    low, high = (3, 16) if glare or sky == "dusk" else (8, 80)
    return {"sun_azimuth_deg": draw.number(-45, 45) if glare else draw.number(-180, 180),
            "sun_elevation_deg": draw.number(low, high), "sun": draw.number(*sun), "sky": draw.spread(*brightness),
            "clouds": draw.number(*clouds), "cloud_size": draw.spread(0.3, 2.5),
            "cloud_seed": draw.randint(500, 999) if draw.held_out else draw.randint(0, 499),
            "visibility": draw.spread(*visibility, digits=0), **sky_colours(draw, sky)}


def water(draw):
    """Waves whose slopes add up to 7 degrees at most."""
    waves = []
    heading = draw.number(-180, 180)
    for _ in range(draw.randint(0, 4)):
        length, slope = draw.spread(3, 25), math.radians(draw.number(0.3, 1.8))
        waves.append({"amplitude": round(slope * length / (2 * math.pi), 4), "length": length,
                      "heading_deg": round(heading + draw.number(-50, 50), 2), "phase_deg": draw.number(0, 360)})
    material = {"colour": draw.like(draw.choice(WATER), 0.5), "reflectivity": 0.05, "gloss": 0.9}
    return {"kind": "water", "waves": waves, "material": material}


def land(draw):
    colour = draw.like(draw.choice(sorted(LAND.values())), 0.4)
    out = {"kind": "plane", "material": draw.material(colour, (0.2, 3), plain=0.3)}
    if draw.chance(0.25):
        out.update(kind="rough", roughness=draw.number(0.03, 0.25), grain=draw.number(1.5, 6), half_extent=80.0,
                   seed=draw.randint(1, 1000000))
    elif draw.chance(0.3):
        out["slope_deg"] = [draw.number(-4, 4), draw.number(-4, 4)]
    return out


def camera(draw, usv):
    """The vessel's camera more often than not, else another lens on it; faults of each kind vary."""
    out = dict(USV_CAMERA)
    if not usv:
        out.update(width=640, height=480, fx=round(320 / math.tan(math.radians(draw.number(60, 105) / 2)), 1))
    out.update(fy=out["fx"], cx=(out["width"] - 1) / 2, cy=(out["height"] - 1) / 2)
    height = draw.near(1.1, 0.1) if usv and draw.chance(0.7) else draw.number(0.4, 2.2)
    out.update(name="camera", rate=1 / PAUSE, pose=[0, 0, height, draw.number(-2, 2), draw.number(-4, 8), 0],
               encoding="jpeg", jpeg_quality=draw.randint(75, 95), threads=1, samples=2 if draw.chance(0.12) else 1,
               brightness=draw.number(0.13, 0.33), white_time=draw.spread(1, 15), max_exposure_time=draw.number(8, 33),
               full_well=draw.spread(5000, 20000), read_noise=draw.number(1.5, 6), vignetting=draw.number(0, 0.4),
               glare=draw.spread(0.03, 0.3))
    return out


def way(draw, wet):
    """Where the robot passes, and the keys that take it there."""
    seconds = PAUSE * (FRAMES - 1)
    speed = 0.0 if draw.chance(0.25) else draw.spread(0.3, 2.0)
    bend = draw.number(-40, 40)
    reach = max(0.0, speed * seconds)
    turn = math.radians(bend)
    places = [(0.0, 0.0, 0.0)]
    if speed:
        first, second = 0.5 * reach, 0.5 * reach + 2.0
        middle = (first, 0.0)
        end = (first + second * math.cos(turn), second * math.sin(turn))
        places += [(*middle, turn), (*end, turn)]
    keys = {"floats": True} if wet else {}
    if speed:
        keys["motion"] = {"points": [[round(x, 3), round(y, 3)] for x, y, _ in places], "speed": speed,
                          "acceleration": draw.number(0.5, 2), "turn_rate_deg": draw.number(20, 80), "corner": 1.0}
    else:
        keys["pose"] = [0, 0, 0]
    if draw.chance(0.7):
        shake = "waves" if wet else draw.choice(["gait", "road"])
        keys.setdefault("motion", {})["shake"] = {"preset": shake, "scale": draw.number(0.3, 1.5)}
    return places, keys
