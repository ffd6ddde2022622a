"""Worlds of the package, changed for an experiment and written where make_bag reads them."""
import copy

import yaml

import stage_run

# What makes a sensor's measurements wrong, by its kind (config/sensors/): noise and offsets.
RANGING = ("range_noise", "range_noise_square", "range_noise_weak", "slant_noise", "range_bias", "range_scale", "angle_noise")
ERRORS = {
    "lidar3d": RANGING,
    "scanner2d": RANGING,
    "camera": ("read_noise",),
    "imu": ("gyro_noise", "gyro_bias", "gyro_walk", "accel_noise", "accel_bias", "accel_walk"),
    "leg_odometry": ("scale_error", "yaw_drift", "distance_noise", "yaw_noise", "slip", "slip_yaw", "vibration"),
}
LIMITS = {  # what the sensors take at most
    "slant_noise": 1.0, "range_scale": 0.1, "range_noise_weak": 1.0, "range_bias": 1.0, "angle_noise": 5.0,
    "gyro_noise": 10.0, "gyro_bias": 50.0, "gyro_walk": 1.0, "accel_bias": 1000.0, "accel_walk": 100.0,
    "scale_error": 50.0, "yaw_drift": 50.0, "distance_noise": 1.0, "yaw_noise": 90.0, "slip": 1.0, "slip_yaw": 90.0, "vibration": 100.0}

MOUNT_ERROR, CLOCK_ERROR = {"angle_deg": 0.2, "place": 0.005}, 0.002  # of a mount that says nothing: deg, m, s
# What a user of the robot knows of the bodies of a world, {stage: {parameter: value}}; its cages have 4 and 5 m.
KNOWN = {"usv_harbour": {"match": {"class_diameters": {"cage": 4.5}, "class_nets": {"cage": 3.9}, "size_spread": 0.2}}}


class BadDegrade(ValueError):
    pass


def shipped(name):
    return yaml.safe_load((stage_run.package() / f"config/worlds/{name}.yaml").read_text())


def at_anchor(world, name, bodies):
    """The robot of `world` at its origin, at rest among other bodies."""
    robot = {key: value for key, value in world["robot"].items() if key != "motion"}
    return {**world, "name": name, "bodies": bodies, "robot": {**robot, "pose": [0, 0, 0]}}


def with_mounts(world, changes):
    """`changes`: {name of the mount: {key: value}}."""
    mounts = [{**mount, **changes.get(mount["name"], {})} for mount in world["robot"]["mounts"]]
    return {**world, "robot": {**world["robot"], "mounts": mounts}}


def place_of(world, mount):
    """[m] Where it sits, in the robot's frame."""
    return next(m["pose"] for m in world["robot"]["mounts"] if m["name"] == mount)[:3]


def degraded(world, factors):
    """The world with the errors of its sensors multiplied, {name of the mount: factor}."""
    world = copy.deepcopy(world)
    mounts = {mount["name"]: mount for mount in world["robot"]["mounts"]}
    for name, factor in factors.items():
        if name not in mounts:
            raise BadDegrade(f"no sensor {name}; there are {', '.join(sorted(mounts))}")
        mount = mounts[name]
        model = yaml.safe_load((stage_run.package() / f"config/sensors/{mount['model']}.yaml").read_text())
        if model["kind"] not in ERRORS:
            raise BadDegrade(f"the errors of a {model['kind']} such as {name} are not multiplied yet")
        wrong = {**MOUNT_ERROR, **mount.get("mount_error", {})}
        mount["mount_error"] = {key: factor * value for key, value in wrong.items()}
        mount["clock_error"] = factor * mount.get("clock_error", CLOCK_ERROR)
        for key in ERRORS[model["kind"]]:
            wrong = factor * float(mount.get(key, model[key]))
            mount[key] = min(wrong, LIMITS.get(key, wrong))
    return world


def write(world, folder):
    """Writes it below `folder`, beside the sensors that come with the package; the file."""
    (folder / "worlds").mkdir(parents=True, exist_ok=True)
    sensors = folder / "sensors"
    if not sensors.exists():
        sensors.symlink_to(stage_run.package() / "config/sensors")
    file = folder / "worlds" / f"{world['name']}.yaml"
    file.write_text(yaml.safe_dump(world))
    return file
