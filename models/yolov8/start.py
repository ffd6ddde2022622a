"""The network that a training begins with: random, or that of an earlier one."""
from . import checkpoint
from .augment import letterboxed
from .loader import collated, network_input
from .network import YoloV8

IMAGES = 32  # that show the channels' means and variances


def exported_network(path, data, wanted):
    from . import onnx_weights  # needs the onnx package, which training else does not

    images, _ = collated([letterboxed(sample, data.size) for sample in data.samples[:IMAGES]])
    try:
        return onnx_weights.unfolded(path, network_input(images, "cpu"), width=wanted["width"], depth=wanted["depth"])
    except Exception as fault:  # of the file system, of protobuf, of shapes: all mean the same here
        raise checkpoint.CheckpointError(f"{path}: no exported detector of {wanted}: {fault}") from None


def saved_network(path):
    facts, tensors = checkpoint.load(path)
    return checkpoint.network_of(facts, tensors), facts["names"]


def first_network(settings, data):
    random = YoloV8(len(data.names), settings.width, settings.depth)
    path = settings.weights
    if path is None:
        return random
    exported = path.endswith(".onnx")
    network, names = exported_network(path, data, random.config) if exported else saved_network(path)
    if network.config != random.config or names != data.names:
        raise checkpoint.CheckpointError(f"{path}: its network and classes are {network.config}, {names}; "
                                         f"asked for are {random.config}, {data.names}")
    return network.train()
