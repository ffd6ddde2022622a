"""The weights of an exported detector, to train it on: the file has no normalisation any more, so a new one is made."""
import ast

import numpy as np
import onnx
import torch
from onnx import numpy_helper

from .layers import Conv
from .network import YoloV8


def metadata_of(model):
    return {p.key: p.value for p in model.metadata_props}


def names_of(model):
    """Names of the classes in their order; ValueError where the file has none."""
    metadata = metadata_of(model)
    if "names" not in metadata:
        raise ValueError("it does not name its classes")
    names = ast.literal_eval(metadata["names"])
    return [names[i] for i in range(len(names))]


def check_finite(model):
    """ValueError where a weight is none."""
    for tensor in model.graph.initializer:
        value = numpy_helper.to_array(tensor)
        if value.dtype.kind == "f" and not np.isfinite(value).all():
            raise ValueError(f"{tensor.name} has weights that are no numbers")


def folded_weights(model):
    """By the names that they have in YoloV8; what export cut in two is whole again."""
    found = {t.name: torch.from_numpy(numpy_helper.to_array(t).copy()) for t in model.graph.initializer}
    whole = {name: value for name, value in found.items() if ".parts." not in name}
    for name in [name for name in found if ".parts.0." in name]:
        whole[name.replace(".parts.0.", ".")] = torch.cat([found[name], found[name.replace(".parts.0.", ".parts.1.")]])
    return whole


def give(module, name, weights):
    value, wanted = weights.get(name), module.weight.shape
    if value is None or value.shape != wanted:
        raise ValueError(f"{name} is {'missing' if value is None else list(value.shape)}, not {list(wanted)}")
    module.weight.copy_(value)


def normalise_by(conv, bias):
    """Hook on what the convolution makes: a normalisation by the very channels that it sees, after which comes what the
    folded one would have given."""
    def hook(_, __, made):
        variance, mean = torch.var_mean(made, (0, 2, 3), unbiased=False)
        norm = conv.norm
        norm.running_mean.copy_(mean)
        norm.running_var.copy_(variance)
        norm.weight.copy_((variance + norm.eps).sqrt())
        norm.bias.copy_(mean + bias)
    return conv.conv.register_forward_hook(hook)


@torch.no_grad()
def unfolded(path, images, **shape):
    """(network, names) that compute what the file does, in evaluation mode. `images`: Nx3xHxW, 0..1, whose channels'
    means and variances the normalisations take. ValueError where the file is no YoloV8 of this width and depth."""
    model = onnx.load(str(path))
    check_finite(model)
    names, weights, hooks = names_of(model), folded_weights(model), []
    network = YoloV8(len(names), **shape).eval()
    for name, module in network.named_modules():
        if isinstance(module, Conv):
            give(module.conv, f"{name}.conv.weight", weights)
            hooks.append(normalise_by(module, weights[f"{name}.conv.bias"]))
        elif isinstance(module, torch.nn.Conv2d) and name.startswith("head.") and not name.endswith(".conv"):
            give(module, f"{name}.weight", weights)
            module.bias.copy_(weights[f"{name}.bias"])
    network(images)
    for hook in hooks:
        hook.remove()
    return network, names
