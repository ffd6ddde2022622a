"""Points of depth images in the map that grid_slam has made, by its path and the odometry between: nothing true in them."""
import bisect

import genpy
import numpy
import rosbag

import poses
import quad_stages
import sim_bag
import walk_bag


def transforms(path, odometry):
    """time [s] -> T_map_base: the pose of the path before, and from there on the odometry with its pitch and roll."""
    times = [pose.header.stamp.to_sec() for pose in path.poses]

    def at(time):
        node = max(0, bisect.bisect_right(times, time) - 1)
        T_odom_base = odometry.at(times[node])
        T_map_odom = poses.of_message(path.poses[node].pose) @ numpy.linalg.inv(poses.level(T_odom_base))
        return T_map_odom @ odometry.at(time)

    return at


def points(depth, info, step):
    """n x 3 [m] in the camera's optical frame, of a 16UC1 image: every `step`-th pixel of every such row that has a depth."""
    z = numpy.frombuffer(depth.data, numpy.uint16).reshape(depth.height, depth.step // 2)[::step, :depth.width:step] * 1e-3
    v, u = numpy.nonzero(z)
    z = z[v, u]
    return numpy.c_[(u * step - info.K[2]) / info.K[0] * z, (v * step - info.K[5]) / info.K[4] * z, z]


def odometry_of(bag_file):
    with rosbag.Bag(str(bag_file)) as bag:
        return walk_bag.Track([message for _, message, _ in bag.read_messages(topics=[quad_stages.ODOM])])


def cloud(bag_file, path, every, step, farthest):
    """n x 3 [m] in the map, of every so many [s] and pixels, up to `farthest` [m] ahead of the camera."""
    odometry, static = odometry_of(bag_file), sim_bag.static_transforms(bag_file)
    T_map_base, out, info, last = transforms(path, odometry), [], None, genpy.Time()
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, _ in bag.read_messages(topics=[quad_stages.INFO, quad_stages.IMAGE]):
            stamp = message.header.stamp
            if topic == quad_stages.INFO:
                info = message
            elif stamp >= max(last + genpy.Duration.from_sec(every), path.poses[0].header.stamp) and odometry.covers(stamp.to_sec()):
                last, seen = stamp, points(message, info, step)
                T = T_map_base(stamp.to_sec()) @ sim_bag.chained(static.transforms, "base", message.header.frame_id)
                out.append(poses.apply(T, seen[seen[:, 2] <= farthest]))
    return numpy.concatenate(out) if out else numpy.zeros((0, 3))
