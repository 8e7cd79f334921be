// The connection to the server. It reconnects when the server comes back.

const FIRST_DELAY_MS = 300;
const LONGEST_DELAY_MS = 3000;

export class Connection {
  // `handlers`: onOpen(), onClose(), onText(message), onFrame(buffer), isOver(): whether no connection is wanted after
  // this one. `path`: that of the stream.
  constructor(handlers, path = "stream") {
    this.handlers = handlers;
    this.path = path;
    this.delay = FIRST_DELAY_MS;
    this.connect();
  }

  // Does nothing if the connection is open or begins already.
  connect() {
    if (this.socket && this.socket.readyState <= WebSocket.OPEN) return;
    clearTimeout(this.timer);
    this.socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/${this.path}`);
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
      this.timer = setTimeout(() => this.connect(), this.delay);
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
