// The page's end of the worker: calls are answered in their order, one at a time.
export class Engine {
  #calls = [];
  #current = null;
  #failure = null;

  constructor(worker, wasm) {
    this.worker = worker;
    this.ready = new Promise((resolve, reject) => {
      worker.onerror = (event) => {
        this.#failure = new Error(event.message || 'the worker could not be started');
        reject(this.#failure);
        for (const call of [this.#current, ...this.#calls]) call?.reject(this.#failure);
        this.#current = null;
        this.#calls = [];
      };
      worker.onmessage = ({ data }) => {
        if (data.isReady) return resolve(wasm.then((bytes) => this.call('load', { wasm: bytes })));
        if (!this.#current) return; // after a failure
        const { resolve: done, reject: fail } = this.#current;
        this.#current = null;
        if (data.error) fail(new Error(data.error));
        else done(data);
        this.#next();
      };
    });
  }

  get isIdle() {
    return !this.#current && !this.#calls.length;
  }

  call(operation, message = {}, transfer = []) {
    if (this.#failure) return Promise.reject(this.#failure);
    return new Promise((resolve, reject) => {
      this.#calls.push({
        message: { ...message, operation },
        transfer,
        resolve,
        reject,
      });
      this.#next();
    });
  }

  #next() {
    if (this.#current || !this.#calls.length) return;
    this.#current = this.#calls.shift();
    try {
      this.worker.postMessage(this.#current.message, this.#current.transfer);
    } catch (error) {
      this.#current.reject(error);
      this.#current = null;
      this.#next();
    }
  }
}
