#!/usr/bin/env python3
"""Writes the block with which implicit speed is measured, a cube of neo-Hookean C3D8 that is pressed and sheared in one
increment; CalculiX reads the deck as it is. usage: block.py ELEMENTS_A_SIDE > block.inp"""
import sys

n = int(sys.argv[1])
number = lambda i, j, k: 1 + i + (n + 1) * (j + (n + 1) * k)
span = range(n + 1)
print("*HEADING\nblock of %d neo-Hookean C3D8\n*NODE, NSET=NALL" % n**3)
for k in span:
    for j in span:
        for i in span:
            print("%d, %.9g, %.9g, %.9g" % (number(i, j, k), i / n, j / n, k / n))
print("*ELEMENT, TYPE=C3D8, ELSET=EALL")
for k in range(n):
    for j in range(n):
        for i in range(n):
            low = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
            print(", ".join(map(str, [1 + i + n * (j + n * k)] + low + [node + (n + 1) ** 2 for node in low])))
for name, k in (("BASE", 0), ("TOP", n)):
    print("*NSET, NSET=%s, GENERATE\n%d, %d" % (name, number(0, 0, k), number(n, n, k)))
print("""*MATERIAL, NAME=RUBBER
*HYPERELASTIC, NEO HOOKE
0.5, 0.1
*SOLID SECTION, ELSET=EALL, MATERIAL=RUBBER
*STEP, NLGEOM
*STATIC
1., 1.
*BOUNDARY
BASE, 1, 3
TOP, 1, 1, 0.1
TOP, 2, 2
TOP, 3, 3, -0.15
*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1
RF
*END STEP""")
