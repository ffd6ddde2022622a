"""Where the recordings and the model lie, and what is known of the drive `kitti_sequence`."""
import os
import pathlib

SEQUENCE = "kitti_sequence"
FOLDERS = {"sequence": SEQUENCE, "tracking": "kitti_tracking", "object": "kitti_object"}
MODEL = "yolov8n_coco/yolov8n_deq_fp32.onnx"
LIDAR_HEIGHT = 1.73  # m above the road (Geiger et al. 2013)

# of `kitti_sequence`: the car ahead in the own lane
FRAMES = 10
CAR_AHEAD = {0: 7.98, 1: 7.92, 5: 7.69, 9: 7.43}  # m along x from the LiDAR to its rear, by frame
VEHICLES = ("car", "truck", "bus")  # COCO's names for it
HALF_LANE = 1.5  # m


def folder():
    """$FIELD_FUSION_DATA, None where that is not set."""
    data = os.environ.get("FIELD_FUSION_DATA")
    return pathlib.Path(data).resolve() if data else None
