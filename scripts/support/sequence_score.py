"""`kitti_sequence`: ten frames of a real drive, the car ahead in the own lane.

A frame counts as fused when LiDAR and camera agree on a vehicle in the own lane. Its range is where its rear begins
along x, the LiDAR's forward axis: what 1 % of its cluster's points are nearer than. The nearest point of all, where
the box begins, is printed beside it: it is a stray return in some frames, up to 0.3 m before the bumper.
"""
import math

import figures
import kitti_run
from kitti_data import CAR_AHEAD, HALF_LANE, LIDAR_HEIGHT, VEHICLES

STRAY = 0.01  # share of a cluster's points that may lie before the rear
COLUMNS = ("frame", "label", "rear_m", "box_m", "truth_m")


def car_ahead(obstacles, clusters):
    """(x of the rear, x of the box, label) of the nearest vehicle that both sensors see in the own lane; None
    where there is none."""
    seen = []
    for obstacle in obstacles.obstacles:
        if obstacle.source != obstacle.SOURCE_BOTH or obstacle.label not in VEHICLES:
            continue
        if abs(obstacle.position.y) < HALF_LANE and obstacle.position.z > -LIDAR_HEIGHT:
            cluster = clusters.clusters[obstacle.cluster_id]
            points = clusters.points[cluster.first_point:cluster.first_point + cluster.point_count]
            rear = sorted(point.x for point in points)[int(STRAY * len(points))]
            seen.append((rear, cluster.min.x, obstacle.label))
    return min(seen, default=None)


def run(session, recording, folder, model):
    """One row a frame, see COLUMNS; NaN for what is not known."""
    rows = []
    for frame, answer in kitti_run.play(session, recording, folder, model):
        rear, box, label = car_ahead(answer["/obstacles"], answer["/clusters"]) or (math.nan, math.nan, "-")
        rows.append((frame, label, rear, box, CAR_AHEAD.get(frame, math.nan)))
        print("frame {}  {:6} rear {:.3f} m  box {:.3f} m  truth {:.2f} m".format(*rows[-1]))
    return rows


def report(rows):
    """The lines of the figures."""
    fused = sum(label != "-" for _, label, *_ in rows)
    share = figures.wilson(fused, len(rows))
    yield figures.line("kitti/sequence/fused_frames", fused, f"of-{len(rows)}", len(rows),
                       [len(rows) * edge for edge in share])
    checked = [row for row in rows if row[0] in CAR_AHEAD]
    for name, column in (("range_max_error", 2), ("range_max_error_box", 3)):
        yield figures.worst(f"kitti/sequence/{name}", [abs(row[column] - row[4]) for row in checked], "m")
