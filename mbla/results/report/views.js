/* Views begin when they come near the screen, and few are alive at once: a browser draws 16 scenes with WebGL at most,
   and takes the first ones away without a word when a page has more. One that was ended begins again when it is seen. */
(function () {
  "use strict";
  const MOST_ALIVE = 6;
  const begin = window.mblaView3d;
  const views = new Map();
  const alive = [];

  function end(view) {
    for (const button of view.host.querySelectorAll("button")) {
      if (button.textContent === "stop") button.click();
    }
    view.host.style.minHeight = `${view.host.offsetHeight}px`;
    for (const plot of view.host.querySelectorAll(".js-plotly-plot")) window.Plotly.purge(plot);
    view.host.replaceChildren(...view.first.map((node) => node.cloneNode(true)));
    delete view.host.dataset.mblaReady;
  }

  function start(view) {
    alive.push(view);
    const old = alive.find((each) => !each.seen);
    if (alive.length > MOST_ALIVE && old) {
      alive.splice(alive.indexOf(old), 1);
      end(old);
    }
    Promise.resolve(begin(view.host, view.data)).then(() => { view.host.style.minHeight = ""; });
  }

  const watch = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const view = views.get(entry.target);
      view.seen = entry.isIntersecting;
      if (view.seen && !alive.includes(view)) start(view);
    }
  }, { rootMargin: "300px" });

  window.mblaView3d = (host, data) => {
    const first = [...host.childNodes].map((node) => node.cloneNode(true));
    views.set(host, { host, data, first, seen: false });
    host.style.minHeight = "34rem";
    watch.observe(host);
  };
})();
