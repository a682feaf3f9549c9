// A uniform struct laid out by the members that the plan lists of it.

const SCALARS = { f32: 'setFloat32', u32: 'setUint32', i32: 'setInt32' };

// The scalar of a WGSL type, its components along a column and its columns.
function shape(type) {
  if (SCALARS[type]) return { scalar: type, rows: 1, columns: 1 };
  const [, vector, ofVector] = /^vec([234])([fui])$/.exec(type) ?? [];
  if (vector) return { scalar: `${ofVector}32`, rows: Number(vector), columns: 1 };
  const [, columns, rows] = /^mat([234])x([234])f$/.exec(type) ?? [];
  if (columns) return { scalar: 'f32', rows: Number(rows), columns: Number(columns) };
  throw new Error(`members of the type ${type} cannot be written; give the struct as bytes`);
}

/** The names of a value's members, those of members joined by points, with what they hold. */
function* members(value, prefix = '') {
  for (const [name, held] of Object.entries(value)) {
    const isStruct = typeof held === 'object' && held !== null && !Array.isArray(held) && !ArrayBuffer.isView(held);
    if (isStruct) yield* members(held, `${prefix}${name}.`);
    else yield [prefix + name, held];
  }
}

/**
 * Bytes of a struct that has `fields`, from an object with a value for each. `padding` is left out; numbers are rounded to what their
 * type holds. A member too few or too many is an error.
 */
export function structBytes(size, fields, value) {
  const given = new Map(members(value));
  const view = new DataView(new ArrayBuffer(size));
  for (const { name, type, offset, count, stride } of fields) {
    if (!given.has(name)) {
      if (name.split('.').at(-1) === 'padding') continue;
      throw new Error(`its member '${name}' (${type}) is missing`);
    }
    const numbers = flat(given.get(name));
    given.delete(name);
    const { scalar, rows, columns } = shape(type);
    if (numbers.length !== rows * columns * count) {
      throw new Error(`its member '${name}' (${type}) has ${numbers.length} numbers; it takes ${rows * columns * count}`);
    }
    const column = columns > 1 ? 4 * (rows === 3 ? 4 : rows) : 0;
    numbers.forEach((number, index) => {
      const fits = typeof number === 'number' && (scalar === 'f32' || number === (scalar === 'u32' ? number >>> 0 : number | 0));
      if (!fits) throw new Error(`its member '${name}' (${type}) has the number ${number}, which is no ${scalar}`);
      const [element, within] = [Math.floor(index / (rows * columns)), index % (rows * columns)];
      const place = offset + element * stride + Math.floor(within / rows) * column + (within % rows) * 4;
      view[SCALARS[scalar]](place, number, true);
    });
  }
  for (const name of given.keys()) {
    if (name.split('.').at(-1) === 'padding') continue;
    throw new Error(`it has no member '${name}'; it has ${fields.map((field) => field.name).join(', ')}`);
  }
  return new Uint8Array(view.buffer);
}

const flat = (value) => (typeof value === 'object' && value !== null ? Array.from(value).flatMap(flat) : [value]);
