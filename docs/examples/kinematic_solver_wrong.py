#!/usr/bin/env python3
"""The solver of kinematic_solver.py with one mistake that looks right.

The wave equation is written with the chain rule, d phi/dt + f'(phi) d phi/dz = 0, and each cell
takes the slope from where f' says that its news comes.  Wherever phi is smooth that is the same
equation; its pictures look alike.  But fronts are jumps, at which the chain rule does not hold:
they move at another speed, and solid is lost.  bedcheck says so:

    bedcheck run suspension/compaction-kinematic --solver docs/examples/kinematic_solver_wrong.py
"""

import sys

import numpy as np

import kinematic_solver


class WrongBed(kinematic_solver.Bed):
    def step(self, dt):
        news = self.speed * (2 * self.phi - self.after)  # f'
        under = np.concatenate(([self.after], self.phi[:-1]))
        over = np.concatenate((self.phi[1:], [0.0]))
        rise = np.where(news > 0, self.phi - under, over - self.phi)
        self.phi = self.phi - dt / self.cell * news * rise


if __name__ == "__main__":
    sys.exit(kinematic_solver.main(WrongBed))
