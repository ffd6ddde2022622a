"""An ONNX detector run through OpenCV, to be scored: one of ours, or one with the head of a stock export."""
import cv2
import numpy as np
import onnx
import torch

from .detections import Detections, detections_of, suppressed
from .network import BOX_ROWS, STRIDES
from .onnx_weights import check_finite, names_of


class OnnxError(Exception):
    pass


class OnnxModel:
    def __init__(self, path):
        try:
            model = onnx.load(str(path))
            self.net = cv2.dnn.readNetFromONNX(str(path))
            self.names = names_of(model)
            check_finite(model)
        except Exception as fault:  # each of the two libraries has kinds of its own
            raise OnnxError(f"{path}: {fault}") from None
        shape = [d.dim_value for d in model.graph.input[0].type.tensor_type.shape.dim]
        if len(shape) != 4 or shape[:2] != [1, 3] or min(shape) <= 0:
            raise OnnxError(f"{path}: input {shape}, not 1x3xHxW of fixed size")
        self.size = (shape[3], shape[2])

    def __call__(self, images, confidence, overlap):
        """Images Nx3xHxW (RGB uint8) to Detections [px of the input], one each."""
        return [self._one(image, confidence, overlap) for image in images.numpy()]

    def _one(self, image, confidence, overlap):
        self.net.setInput(image[None].astype(np.float32) / 255)
        outputs = self.net.forward(self.net.getUnconnectedOutLayersNames())
        rows = BOX_ROWS + len(self.names)
        if len(outputs) == len(STRIDES) and all(o.ndim == 4 and o.shape[1] == rows for o in outputs):
            fine_first = sorted(outputs, key=lambda o: -o.size)
            return detections_of([torch.from_numpy(o) for o in fine_first], confidence, overlap)[0]
        if len(outputs) == 1 and outputs[0].ndim == 3 and outputs[0].shape[1] == 4 + len(self.names):
            return stock_detections(outputs[0][0], confidence, overlap)
        raise OnnxError(f"outputs {[o.shape for o in outputs]} are not those of a YOLOv8 detector of {len(self.names)} classes")


def stock_detections(rows, confidence, overlap):
    """From rows x, y, width, height [px of the input] and the scores 0..1 of each cell."""
    scores, classes = rows[4:].max(0), rows[4:].argmax(0)
    kept = np.nonzero(scores >= confidence)[0]
    middle, half = rows[:2, kept].T, rows[2:4, kept].T / 2
    boxes, scores, classes = np.concatenate([middle - half, middle + half], 1), scores[kept], classes[kept]
    kept = suppressed(boxes, scores, classes, overlap)
    return Detections(boxes[kept], scores[kept], classes[kept])


def renamed(found, names, wanted):
    """Detections with the numbers that the classes have in `wanted`; those of other classes dropped."""
    numbers = np.array([wanted.index(name) if name in wanted else -1 for name in names])
    classes = numbers[found.classes]
    return Detections(found.boxes[classes >= 0], found.scores[classes >= 0], classes[classes >= 0])
