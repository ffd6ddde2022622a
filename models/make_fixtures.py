#!/usr/bin/env python3
"""Writes the ONNX files of test/fixtures: networks of a few kB that stand in for a YOLOv8 model.

  models/make_fixtures.py [FOLDER]

Their output follows from the mean colour of the input, so a test can compute it by hand. For an input of
1x3x32x32 the stock head has 21 anchors (16 + 4 + 1) and, with two classes, 6 rows. Anchor 0 is a box of
16x8 px around (16, 16) whose score in class 0 is the mean of red, anchor 1 a box of 8x8 px around (8, 12)
whose score in class 1 is the mean of green; all other scores are 0. Needs python3-onnx.
"""
import pathlib
import sys

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

ROWS, ANCHORS = 6, 21
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
    return weight.reshape(-1, 3, 1, 1), bias.reshape(-1)


def model(output_shape, last_node, metadata=None):
    weight, bias = head()
    nodes = [
        helper.make_node("GlobalAveragePool", ["images"], ["mean"], name="mean"),
        helper.make_node("Conv", ["mean", "weight", "bias"], ["flat"], name="head", kernel_shape=[1, 1]),
        helper.make_node(last_node, ["flat", "shape"], ["output0"], name="last"),
    ]
    graph = helper.make_graph(
        nodes, "fixture",
        [helper.make_tensor_value_info("images", TensorProto.FLOAT, [1, 3, 32, 32])],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, output_shape)],
        [numpy_helper.from_array(weight, "weight"), numpy_helper.from_array(bias, "bias"),
         numpy_helper.from_array(np.array(output_shape, np.int64), "shape")])
    made = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 12)], producer_name="field_fusion")
    made.ir_version = 7
    helper.set_model_props(made, metadata if metadata is not None else {"names": NAMES})
    return made


def main():
    default = pathlib.Path(__file__).parents[1] / "test/fixtures"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    models = {
        "stock_head.onnx": model([1, ROWS, ANCHORS], "Reshape"),
        "unnamed_classes.onnx": model([1, ROWS, ANCHORS], "Reshape", {}),
        "transposed_head.onnx": model([1, ANCHORS, ROWS], "Reshape"),
        "unknown_operator.onnx": model([1, ROWS, ANCHORS], "NoSuchOperator"),
    }
    for name, made in models.items():
        onnx.save(made, str(folder / name))
        print(folder / name)


if __name__ == "__main__":
    main()
