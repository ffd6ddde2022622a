#!/usr/bin/env python3
"""Writes the ONNX files of test/fixtures: networks of a few kB that stand in for a YOLOv8 model.

  models/make_fixtures.py [FOLDER]

Their output follows from the mean colour of the input, so a test can compute it by hand. For an input of
1x3x32x32 the stock head has 21 anchors (16 + 4 + 1) and, with two classes, 6 rows. Anchor 0 is a box of
16x8 px around (16, 16) whose score in class 0 is the mean of red, anchor 1 a box of 8x8 px around (8, 12)
whose score in class 1 is the mean of green; all other scores are 0.

The raw head has the maps of strides 8, 16 and 32. Cell (1, 1) of the first is a box from (4, 4) to (28, 20)
whose score in class 0 is sigmoid(10 red - 5), the cell of the last a box over the whole input whose score in
class 1 is sigmoid(10 green - 5); all other scores are sigmoid(-10). Needs python3-onnx.
"""
import pathlib
import sys

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

ROWS, ANCHORS = 6, 21
RAW_ROWS, RAW_SIDES = 66, (4, 2, 1)
NAMES = "{0: 'red', 1: 'green'}"


def head():
    """Weight of each mean colour and bias, for each element of the head."""
    weight = np.zeros((ROWS, ANCHORS, 3), np.float32)
    bias = np.zeros((ROWS, ANCHORS), np.float32)
    bias[:4] = np.array([[4], [4], [2], [2]])
    bias[:4, 0] = 16, 16, 16, 8
    bias[:4, 1] = 8, 12, 8, 8
    weight[4, 0, 0] = 1.0
    weight[5, 1, 1] = 1.0
    return weight, bias


def raw_head():
    """The same for the three maps, of 4x4, 2x2 and 1x1 cells."""
    maps = []
    for side in RAW_SIDES:
        weight = np.zeros((RAW_ROWS, side, side, 3), np.float32)
        bias = np.zeros((RAW_ROWS, side, side), np.float32)
        bias[64:] = -10
        maps.append((weight, bias))
    weight, bias = maps[0]
    for row in (1, 16 + 1, 32 + 2, 48 + 1):  # one bin each for left, top, right, bottom
        bias[row, 1, 1] = 20
    weight[64, 1, 1, 0], bias[64, 1, 1] = 10, -5
    weight, bias = maps[2]
    for row in range(0, 64, 16):
        bias[row:row + 2] = 20
    weight[65, 0, 0, 1], bias[65, 0, 0] = 10, -5
    return maps


def branch(nodes, weights, name, weight, bias, shape, last_node="Reshape"):
    """From the mean colour to one output of this shape."""
    nodes += [
        helper.make_node("Conv", ["mean", f"weight{name}", f"bias{name}"], [f"flat{name}"], name=f"head{name}",
                         kernel_shape=[1, 1]),
        helper.make_node(last_node, [f"flat{name}", f"shape{name}"], [f"output{name}"], name=f"last{name}"),
    ]
    weights += [numpy_helper.from_array(weight.reshape(-1, 3, 1, 1), f"weight{name}"),
                numpy_helper.from_array(bias.reshape(-1), f"bias{name}"),
                numpy_helper.from_array(np.array(shape, np.int64), f"shape{name}")]
    return helper.make_tensor_value_info(f"output{name}", TensorProto.FLOAT, shape)


def network(nodes, weights, outputs, metadata):
    mean = helper.make_node("GlobalAveragePool", ["images"], ["mean"], name="mean")
    image = helper.make_tensor_value_info("images", TensorProto.FLOAT, [1, 3, 32, 32])
    graph = helper.make_graph([mean, *nodes], "fixture", [image], outputs, weights)
    made = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 12)], producer_name="field_fusion")
    made.ir_version = 7
    helper.set_model_props(made, metadata)
    return made


def model(output_shape, last_node, metadata=None):
    nodes, weights = [], []
    output = branch(nodes, weights, 0, *head(), output_shape, last_node)
    return network(nodes, weights, [output], {"names": NAMES} if metadata is None else metadata)


def raw_model():
    nodes, weights = [], []
    outputs = [branch(nodes, weights, i, *maps, [1, RAW_ROWS, side, side])
               for i, (side, maps) in enumerate(zip(RAW_SIDES, raw_head()))]
    return network(nodes, weights, outputs, {"names": NAMES})


def main():
    default = pathlib.Path(__file__).parents[1] / "test/fixtures"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    models = {
        "stock_head.onnx": model([1, ROWS, ANCHORS], "Reshape"),
        "raw_head.onnx": raw_model(),
        "unnamed_classes.onnx": model([1, ROWS, ANCHORS], "Reshape", {}),
        "transposed_head.onnx": model([1, ANCHORS, ROWS], "Reshape"),
        "unknown_operator.onnx": model([1, ROWS, ANCHORS], "NoSuchOperator"),
    }
    for name, made in models.items():
        onnx.save(made, str(folder / name))
        print(folder / name)


if __name__ == "__main__":
    main()
