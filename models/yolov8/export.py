"""The trained network as an ONNX file that OpenCV 4.2 and newer, OpenVINO and ONNX Runtime load."""
import copy
import inspect

import onnx
import torch
from onnx import checker, helper, numpy_helper
from torch import nn

from .layers import C2f, Conv
from .network import STRIDES, YoloV8

OPSET = 12


def folded_conv(conv):
    """The same with its normalisation in the convolution's weights."""
    scale = conv.norm.weight / (conv.norm.running_var + conv.norm.eps).sqrt()
    old = conv.conv
    new = type(conv)(old.in_channels, old.out_channels, old.kernel_size[0], old.stride[0], folded=True)
    new.conv.weight = nn.Parameter(old.weight * scale[:, None, None, None])
    new.conv.bias = nn.Parameter(conv.norm.bias - conv.norm.running_mean * scale)
    return new


class Halves(nn.Module):
    """A folded convolution cut in two: OpenCV 4.2 knows neither Split nor Slice."""

    def __init__(self, conv):
        super().__init__()
        old = conv.conv
        half = old.out_channels // 2
        self.parts = nn.ModuleList(Conv(old.in_channels, half, folded=True) for _ in range(2))
        for part, rows in zip(self.parts, (slice(None, half), slice(half, None))):
            part.conv.weight = nn.Parameter(old.weight[rows])
            part.conv.bias = nn.Parameter(old.bias[rows])

    def forward(self, x):
        return [part(x) for part in self.parts]


def doubling(channels):
    """Repeats each cell twice in both directions, as a convolution: every backend has that one."""
    conv = nn.ConvTranspose2d(channels, channels, 2, 2, groups=channels, bias=False)
    nn.init.ones_(conv.weight)
    return conv


@torch.no_grad()
def folded(network):
    """A copy for inference that computes the same. Its convolutions have biases and no normalisation."""
    network = copy.deepcopy(network).cpu().float().eval()
    for module in list(network.modules()):
        for name, child in module.named_children():
            if isinstance(child, Conv):
                setattr(module, name, folded_conv(child))
    return network.requires_grad_(False)


@torch.no_grad()
def prepared(network):
    """A folded copy out of operators that every backend knows."""
    network = folded(network)
    for module in network.modules():
        if isinstance(module, C2f):
            module.enter = Halves(module.enter)
    neck = network.neck
    neck.up5 = doubling(network.backbone.pool.leave.conv.out_channels)
    neck.up4 = doubling(neck.top4.leave.conv.out_channels)
    return network.requires_grad_(False)


def write_graph(network, size, path):
    width, height = size
    options = {"dynamo": False} if "dynamo" in inspect.signature(torch.onnx.export).parameters else {}
    torch.onnx.export(prepared(network), torch.zeros(1, 3, height, width), str(path), opset_version=OPSET,
                      input_names=["images"], output_names=[f"stride{s}" for s in STRIDES], **options)


def without_shared_weights(model):
    """Equal weights are stored once by torch and named twice through Identity, which OpenCV 4.6 refuses."""
    weights = {tensor.name: tensor for tensor in model.graph.initializer}
    for node in [n for n in model.graph.node if n.op_type == "Identity" and n.input[0] in weights]:
        copied = numpy_helper.from_array(numpy_helper.to_array(weights[node.input[0]]), node.output[0])
        model.graph.initializer.append(copied)
        model.graph.node.remove(node)


def export(network, names, size, path, facts):
    """`facts`: further metadata, of words. The names of the classes stand where the `detect` stage looks for them."""
    if not isinstance(network, YoloV8) or network.config["classes"] != len(names):
        raise ValueError(f"{len(names)} names, but the network has {network.config['classes']} classes")
    write_graph(network, size, path)
    model = onnx.load(str(path))
    without_shared_weights(model)
    helper.set_model_props(model, {"names": str(dict(enumerate(names))), **facts})
    checker.check_model(model)
    onnx.save(model, str(path))
