// The keys of the page. They have the same functions as in the windows.

// `parts`: state, actions, toolbar, inspector, picture, viewpoints, past, film, help, log, list, functionKeys of the
// page.
export function keysOf({ state, actions, toolbar, inspector, picture, viewpoints, past, film, help, log, list, functionKeys }) {
  const leave = () => {
    if (!help.element.hidden) help.toggle(false);
    else if (picture.aboard !== null || picture.flight) picture.leaveRobot();
    else actions.select(null);
  };
  return {
    " ": () => (state.recorded ? past.play() : toolbar.pause.click()),
    n: () => actions.step(1),
    N: () => actions.step(10),
    "+": () => (past.isOn ? past.changePace(1) : actions.changeSpeed(1)),
    "-": () => (past.isOn ? past.changePace(-1) : actions.changeSpeed(-1)),
    f: () => state.selected !== null && actions.follow(state.selected),
    k: () => inspector.togglePin(),
    i: () => actions.toggle("ids"),
    l: () => actions.toggle("trails"),
    b: () => actions.toggle("beams"),
    s: () => actions.toggle("shadows"),
    t: () => actions.toggle("textures"),
    r: () => actions.toggle("rays"),
    c: () => actions.toggle("bodies"),
    x: () => actions.toggle("links"),
    o: () => actions.board(),
    u: () => viewpoints.fly(),
    v: () => picture.switchView(),
    m: () => actions.switchTool("measures"),
    h: () => state.control === "granted" && actions.switchTool("handles"),
    j: () => actions.toggleHeat(),
    w: () => inspector.toggleSwarm(),
    y: () => actions.shareLink(),
    P: () => film.toggle(),
    ",": () => past.step(-1),
    ".": () => past.step(1),
    "<": () => past.jumpToEvent(false),
    ">": () => past.jumpToEvent(true),
    z: () => past.play(),
    q: () => past.live(),
    B: () => past.branch(),
    I: () => past.inspect(),
    Delete: () => actions.remove(picture.chosen),
    ArrowLeft: () => picture.step(-1, 0),
    ArrowRight: () => picture.step(1, 0),
    ArrowUp: () => picture.step(0, 1),
    ArrowDown: () => picture.step(0, -1),
    PageUp: () => picture.view?.zoom(1),
    PageDown: () => picture.view?.zoom(-1),
    p: () => actions.savePicture(),
    Home: () => actions.frameArena(),
    End: () => actions.frameArena("top"),
    F1: () => help.toggle(),
    F3: () => actions.togglePanel(),
    F8: () => state.control === "granted" && !state.editor && functionKeys.toggle(),
    g: () => log.toggle(),
    "?": () => help.toggle(),
    "/": () => list.filter.focus(),
    Escape: leave,
  };
}
