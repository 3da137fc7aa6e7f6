// Places on a face, and the triangles between them that it is drawn and picked by.

/// Four triangles about the centre, which is place 4; the others are its corners.
export const QUAD_INDEX = [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4];

/// The same for faces of second order: a grid of places on them.
export const DIVISIONS = 6, GRID = [], GRID_INDEX = [];
for (let j = 0; j <= DIVISIONS; ++j) for (let i = 0; i <= DIVISIONS; ++i) GRID.push(i / DIVISIONS, j / DIVISIONS, 0);
for (let j = 0; j < DIVISIONS; ++j)
  for (let i = 0, row = DIVISIONS + 1; i < DIVISIONS; ++i) {
    const at = j * row + i;
    GRID_INDEX.push(at, at + 1, at + row + 1, at, at + row + 1, at + row);
  }
