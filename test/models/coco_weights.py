"""The weights of an ONNX file with YOLOv8's usual names, put into our network."""
import onnx
import torch
from onnx import numpy_helper

from yolov8.export import folded
from yolov8.network import YoloV8

# their place in the list of layers: ours
BACKBONE = {0: "stem", 1: "down2", 2: "stage2", 3: "down3", 4: "stage3", 5: "down4", 6: "stage4", 7: "down5", 8: "stage5",
            9: "pool"}
NECK = {12: "top4", 15: "out3", 16: "down3", 18: "out4", 19: "down4", 21: "out5"}
PLACES = {**{i: f"backbone.{name}" for i, name in BACKBONE.items()}, **{i: f"neck.{name}" for i, name in NECK.items()}}


def our_name(theirs):
    """"model.2.m.0.cv1.conv" as "backbone.stage2.blocks.0.first.conv"."""
    _, place, *rest = theirs.split(".")
    if place == "22":  # cv2 or cv3, stride, layer
        return ".".join(["head", {"cv2": "boxes", "cv3": "scores"}[rest[0]], *rest[1:]])
    inside = "m" in rest
    names = {"m": "blocks", "cv1": "first" if inside else "enter", "cv2": "second" if inside else "leave"}
    return ".".join([PLACES[int(place)], *(names.get(part, part) for part in rest)])


def load(path, classes=80):
    """The network with the file's weights; every one of ours must be among them, and none may be left over."""
    network = folded(YoloV8(classes))
    weights = {}
    for tensor in onnx.load(str(path)).graph.initializer:
        theirs, found, kind = tensor.name.partition(".weight_quantized_fp32")
        if found and "dfl" not in theirs:
            value = torch.from_numpy(numpy_helper.to_array(tensor).copy())
            weights[our_name(theirs) + (".bias" if kind == "_bias" else ".weight")] = value
    network.load_state_dict(weights, strict=True)
    return network
