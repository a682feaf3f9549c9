// A camera that turns about the scene: by pointers, the wheel and keys.

const LIMITS = { height: [0.08, 1.5], distance: [4, 40] };
const clamp = (value, [low, high]) => Math.min(Math.max(value, low), high);

export class Orbit {
  angle = 0.7;
  height = 0.38;

  /** `moved` is called after each move. */
  constructor(canvas, moved) {
    this.moved = moved;
    // Where the picture is upright less of the scene is seen to the sides.
    this.distance = canvas.clientWidth < canvas.clientHeight ? 13 : 10;
    const pointers = new Map();
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, event);
    });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
    canvas.addEventListener('pointermove', (event) => {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const apart = () => {
        const [a, b] = [...pointers.values()];
        return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
      };
      const pinched = pointers.size === 2 ? apart() : 0;
      pointers.set(event.pointerId, event);
      // Two fingers move the camera, one turns it.
      if (pointers.size === 2) this.move(pinched / Math.max(apart(), 1));
      else this.turn((before.clientX - event.clientX) * 0.008, (event.clientY - before.clientY) * 0.006);
    });
    const wheel = (event) => {
      event.preventDefault();
      this.move(Math.exp(event.deltaY * 0.001));
    };
    canvas.addEventListener('wheel', wheel, { passive: false });
    const keys = {
      ArrowLeft: () => this.turn(-0.06, 0),
      ArrowRight: () => this.turn(0.06, 0),
      ArrowUp: () => this.turn(0, 0.05),
      ArrowDown: () => this.turn(0, -0.05),
      '+': () => this.move(0.95),
      '=': () => this.move(0.95),
      '-': () => this.move(1.05),
    };
    canvas.addEventListener('keydown', (event) => {
      if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  turn(angle, height) {
    this.angle += angle;
    this.height = clamp(this.height + height, LIMITS.height);
    this.moved();
  }

  move(factor) {
    this.distance = clamp(this.distance * factor, LIMITS.distance);
    this.moved();
  }

  /** Where the camera is. */
  get eye() {
    const across = Math.cos(this.height) * this.distance;
    return [across * Math.sin(this.angle), Math.sin(this.height) * this.distance, across * Math.cos(this.angle)];
  }
}
