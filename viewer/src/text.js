// Numbers as people read them.
export const count = number => number.toLocaleString('en');
export const measure = number => number === 0 ? '0' : Math.abs(number) >= 1e5 || Math.abs(number) < 1e-3 ? number.toExponential(3) : String(+number.toPrecision(5));
