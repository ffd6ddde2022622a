#!/usr/bin/env python3
"""Mends a stock Ultralytics export so that OpenCV 4.6 loads it.

  models/prepare_onnx.py IN.onnx OUT.onnx

OpenCV 4.6 adds, subtracts, multiplies and divides a tensor and a constant only where both have the same shape,
or the constant one number. The head of an export has constants of 1x1xN beside tensors of 1x4xN (strides
times boxes): each such constant is expanded to the shape of its partner. An export that was not simplified
also computes where to cut tensors from their shapes (Shape, Gather, Add, Div, Mul), which OpenCV 4.6 refuses:
what follows from fixed shapes is computed here. What the network computes stays the same. Needs python3-onnx.
"""
import argparse
import sys

import numpy as np
import onnx
from onnx import helper, numpy_helper, shape_inference

from yolov8.whole_file import whole

ELEMENTWISE = {"Add": np.add, "Sub": np.subtract, "Mul": np.multiply, "Div": np.floor_divide}


def shapes_of(model):
    """Shape of each tensor whose dimensions are all known."""
    graph = shape_inference.infer_shapes(model).graph
    found = {}
    for value in [*graph.input, *graph.value_info, *graph.output]:
        dimensions = value.type.tensor_type.shape.dim
        if all(d.HasField("dim_value") for d in dimensions):
            found[value.name] = tuple(d.dim_value for d in dimensions)
    return found


def constants_of(graph):
    found = {tensor.name: numpy_helper.to_array(tensor) for tensor in graph.initializer}
    for node in graph.node:
        if node.op_type == "Constant" and node.attribute[0].name == "value":
            found[node.output[0]] = numpy_helper.to_array(node.attribute[0].t)
    return found


def folded(node, inputs, shapes):
    """What a node of shape arithmetic gives, or None for any other."""
    if node.op_type == "Shape":
        shape = shapes.get(node.input[0])
        return None if shape is None else np.array(shape, np.int64)
    if any(value is None or value.dtype != np.int64 for value in inputs):
        return None
    if node.op_type in ELEMENTWISE:
        return ELEMENTWISE[node.op_type](*inputs)
    axis = next((a.i for a in node.attribute if a.name == "axis"), 0)
    if node.op_type == "Gather":
        return np.take(*inputs, axis=axis)
    if node.op_type == "Concat":
        return np.concatenate(inputs, axis=axis)
    return None


def fold(model):
    """Replaces shape arithmetic by its result, in place; the names of the nodes that went."""
    shapes, constants, gone = shapes_of(model), constants_of(model.graph), []
    for node in list(model.graph.node):
        value = folded(node, [constants.get(name) for name in node.input], shapes)
        if value is None:
            continue
        constants[node.output[0]] = value
        model.graph.initializer.append(numpy_helper.from_array(np.asarray(value, np.int64), node.output[0]))
        model.graph.node.remove(node)
        gone.append(node.name or node.output[0])
    return gone


def expand(model):
    """Expands constants to their partners' shapes, in place; the names of the nodes that were mended."""
    shapes, constants = shapes_of(model), constants_of(model.graph)
    mended = []
    for node in model.graph.node:
        if node.op_type not in ELEMENTWISE:
            continue
        for place, name in enumerate(node.input):
            shape = shapes.get(node.input[1 - place])
            value = constants.get(name)
            if value is None or shape is None or value.size == 1 or value.shape == shape:
                continue
            if node.input[1 - place] in constants or np.broadcast_shapes(value.shape, shape) != shape:
                continue
            fresh = f"{node.name or node.output[0]}.{place}.expanded"
            model.graph.initializer.append(
                numpy_helper.from_array(np.ascontiguousarray(np.broadcast_to(value, shape)), fresh))
            node.input[place] = fresh
            mended.append(node.name or node.output[0])
    return mended


def prepare(model):
    """Mends the model in place; the names of the nodes that were mended."""
    return fold(model) + expand(model)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("original", metavar="IN.onnx")
    parser.add_argument("out", metavar="OUT.onnx")
    args = parser.parse_args()
    try:
        model = onnx.load(args.original)
        mended = prepare(model)
        onnx.checker.check_model(model)
    except Exception as error:  # each library below has kinds of its own
        sys.exit(f"prepare_onnx: {args.original}: {error}")
    try:
        with whole(args.out) as part:
            onnx.save(model, str(part))
    except OSError as error:
        sys.exit(f"prepare_onnx: {error}")
    print(f"{args.out}: {len(mended)} nodes mended" + "".join(f"\n  {name}" for name in mended))


if __name__ == "__main__":
    main()
