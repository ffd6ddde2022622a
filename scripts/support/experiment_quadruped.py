"""Quadruped paper (004), sections 4.3 and 5: its obstacles on maps of the LiDAR alone, of both sensors' scan (PF) and of both maps (PMF)."""
import quad_dimensions
import quad_hard
import quad_latency
import quad_obstacles
import quad_stack
import quad_view

TITLE = __doc__
# Modules with `run(experiment)`: lines of a table, then figures.
PARTS = {"obstacles": quad_obstacles, "hard": quad_hard, "view": quad_view, "stack": quad_stack, "dimensions": quad_dimensions,
         "latency": quad_latency}


def options(parser):
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS),
                        help=f"of the experiment (default: {' '.join(PARTS)})")


def check(given):
    pass


def run(experiment):
    """Lines: tables, then figures."""
    lines = [line for name, part in PARTS.items() if name in experiment.given.parts for line in part.run(experiment)]
    return sorted(lines, key=lambda line: line.startswith("figure "))
