// The connection to the server. It reconnects when the server comes back.

const FIRST_DELAY_MS = 300;
const LONGEST_DELAY_MS = 3000;

export class Connection {
  // `handlers`: onOpen(), onClose(), onText(message), onFrame(buffer), isOver(): whether no connection is wanted after
  // this one.
  constructor(handlers) {
    this.handlers = handlers;
    this.delay = FIRST_DELAY_MS;
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/stream`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      this.delay = FIRST_DELAY_MS;
      this.handlers.onOpen();
    };
    this.socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.handlers.onText(JSON.parse(data));
      else this.handlers.onFrame(data);
    };
    this.socket.onclose = () => {
      this.handlers.onClose();
      if (this.handlers.isOver()) return;
      setTimeout(() => this.connect(), this.delay);
      this.delay = Math.min(this.delay * 1.6, LONGEST_DELAY_MS);
    };
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  send(request) {
    if (this.isOpen) this.socket.send(JSON.stringify(request));
  }
}
