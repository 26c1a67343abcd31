// SPDX-License-Identifier: BSD-3-Clause
// Search in pages opened as files, where browsers allow neither fetching the index nor a worker from a file:
// both come in a script, and the worker is made of its text. Served by http, the theme's own way is kept.
(function () {
  if (location.protocol !== "file:") return;
  const source = document.currentScript.dataset.index;
  const script = document.createElement("script");
  const index = new Promise(function (resolve) {
    script.onload = function () { resolve(window.rondo_search.index); };
  });
  script.src = source;
  document.head.appendChild(script);
  window.__search = { index: index };

  const TheWorker = window.Worker;
  window.Worker = function () { // the theme makes one, and sends to it what the index promises
    const waiting = [];
    const stand_in = new EventTarget();
    let worker = null;
    stand_in.postMessage = function (data) {
      if (worker) worker.postMessage(data);
      else waiting.push(data);
    };
    stand_in.terminate = function () { if (worker) worker.terminate(); };
    index.then(function () {
      const text = new Blob([window.rondo_search.worker], { type: "text/javascript" });
      worker = new TheWorker(URL.createObjectURL(text));
      worker.addEventListener("message", function (event) {
        stand_in.dispatchEvent(new MessageEvent("message", { data: event.data }));
      });
      waiting.forEach(function (data) { worker.postMessage(data); });
    });
    return stand_in;
  };
})();
