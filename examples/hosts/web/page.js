// What both pages have around their picture: controls with their values in words, what is wrong, and frames with their times.

export const element = (id) => document.getElementById(id);

// How the value of a slider reads, by the unit that it names.
const READINGS = {
  texels: (value) => `${value} ${value === 1 ? 'texel' : 'texels'}`,
  degrees: (value) => `${value}°`,
  percent: (value) => `${value} %`,
  number: (value) => `${value}`,
};

// Frames whose times a median is taken of.
const MEASURED = 9;

export class Page {
  stopped = false;
  // Whether a frame is asked for, and how many changes it waits for.
  asked = true;
  waiting = 0;
  changes = Promise.resolve();

  constructor() {
    this.picture = element('picture');
    this.sliders = [...document.querySelectorAll('input[type=range]')];
    for (const slider of this.sliders) slider.addEventListener('input', () => this.read());
    this.read();
  }

  /** Writes beside each slider what it is at. */
  read() {
    for (const slider of this.sliders) {
      const words = READINGS[slider.dataset.unit](Number(slider.value));
      document.querySelector(`output[for=${slider.id}]`).textContent = words;
      slider.setAttribute('aria-valuetext', words);
    }
  }

  /** Says what is wrong, or that nothing is. */
  say(message) {
    // What has stopped the page stays.
    if (this.stopped) return;
    const trouble = element('trouble');
    trouble.textContent = message;
    trouble.hidden = !message;
  }

  /** Says what went wrong, and draws no further frame. */
  stop(message) {
    this.say(message);
    this.stopped = true;
    this.picture.removeAttribute('aria-busy');
    element('controls').disabled = true;
  }

  /** Does one thing after the other, such as to fetch a plan or to take a size; no frame is drawn in between. */
  change(work, onError = (error) => this.stop(error.message)) {
    this.waiting += 1;
    this.ask();
    const done = () => this.say('');
    this.changes = this.changes
      .then(work)
      .then(done, onError)
      .finally(() => (this.waiting -= 1));
    return this.changes;
  }

  /** Keeps the canvas as many pixels as the screen shows of it, within what the device has. `take` is told of each size. */
  async fit(device, take) {
    const shown = () => {
      const scale = Math.min(devicePixelRatio, 2);
      const side = (length) => Math.min(Math.max(Math.round(length * scale), 1), device.limits.maxTextureDimension2D);
      return [side(this.picture.clientWidth), side(this.picture.clientHeight)];
    };
    let size = shown();
    await take(...size);
    const fit = () => {
      if (String(shown()) === String(size)) return;
      size = shown();
      this.change(() => take(...size));
    };
    new ResizeObserver(fit).observe(this.picture);
  }

  /** Wants another frame: something that it shows has changed. */
  ask() {
    this.asked = true;
    if (!this.stopped) this.picture.setAttribute('aria-busy', 'true');
  }

  /** Draws a frame by `draw`, which submits it, whenever one is asked for, and says what frames take with `note` behind. */
  async run(device, draw, note) {
    if (this.stopped) return;
    const controls = element('controls');
    controls.disabled = false;
    for (const event of ['input', 'change']) controls.addEventListener(event, () => this.ask());
    const measured = [];
    const frame = async () => {
      if (this.stopped) return;
      if (this.asked && this.waiting === 0) {
        this.asked = false;
        const start = performance.now();
        draw();
        // The next frame waits for this one, so that times are not those of a queue.
        await device.queue.onSubmittedWorkDone();
        performance.mark('drawn');
        measured.unshift(performance.now() - start);
        measured.splice(MEASURED);
        const median = [...measured].sort((a, b) => a - b)[measured.length >> 1];
        element('times').textContent = `${median.toFixed(1)} ms a frame, ${note()}`;
        if (!this.asked) this.picture.removeAttribute('aria-busy');
      }
      requestAnimationFrame(() => frame().catch((error) => this.stop(error.message)));
    };
    await frame();
  }
}
