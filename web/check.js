// Says what is missing where the page cannot start: a script of its own in the JavaScript of 2015, which runs where the page's does not.
(function () {
  var words = {
    en: {
      works: 'Sightline works in Chrome and Edge from version 91, in Firefox from 114 and in Safari from 16.4.',
      modules: 'The page cannot start: this browser does not know JavaScript modules.',
      wasm: 'The page cannot start: WebAssembly is missing in this browser or switched off.',
      simd: 'The page cannot start: this browser or its processor lacks the SIMD instructions of WebAssembly.',
      file: 'The page cannot start: a part of it did not come, or came as something else. Reload the page; if that does not help, the host lacks a file or names a wrong type for it: ',
      start: 'The page cannot start: ',
    },
    ko: {
      works: 'Sightline은 Chrome과 Edge 91, Firefox 114, Safari 16.4 이상에서 작동합니다.',
      modules: '페이지를 시작할 수 없습니다. 이 브라우저는 JavaScript 모듈을 지원하지 않습니다.',
      wasm: '페이지를 시작할 수 없습니다. 이 브라우저에 WebAssembly가 없거나 꺼져 있습니다.',
      simd: '페이지를 시작할 수 없습니다. 이 브라우저나 프로세서가 WebAssembly SIMD 명령을 지원하지 않습니다.',
      file: '페이지를 시작할 수 없습니다. 페이지의 일부를 받지 못했거나 형식이 다릅니다. 새로 고치십시오. 그래도 안 되면 호스트에 파일이 없거나 형식이 잘못 지정되어 있습니다: ',
      start: '페이지를 시작할 수 없습니다: ',
    },
  };
  var language;
  try {
    language = localStorage.getItem('sightline.language');
  } catch (error) {
    // Storage is switched off.
  }
  language = (language || navigator.language || '').indexOf('ko') === 0 ? 'ko' : 'en';
  var told = false;

  function show() {
    var all = document.querySelectorAll('#static [lang]');
    for (var i = 0; i < all.length; i++) all[i].hidden = all[i].lang !== language;
  }

  function tell(what, detail) {
    if (told || window.sightlineStarted) return;
    told = true;
    window.sightlineTrouble = what;
    var write = function () {
      show();
      var place = document.getElementById('trouble');
      if (!place) return;
      place.textContent = words[language][what] + (detail || '') + ' ' + words[language].works;
      place.hidden = false;
      var waiting = document.querySelectorAll('#static .waiting');
      for (var i = 0; i < waiting.length; i++) waiting[i].hidden = true;
    };
    document.readyState === 'loading' ? document.addEventListener('DOMContentLoaded', write) : write();
  }

  document.readyState === 'loading' ? document.addEventListener('DOMContentLoaded', show) : show();

  // An empty module with one function that uses a vector.
  var vector = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);
  if (!('noModule' in document.createElement('script'))) tell('modules');
  else if (typeof WebAssembly !== 'object' || typeof WebAssembly.validate !== 'function') tell('wasm');
  else if (!WebAssembly.validate(vector)) tell('simd');

  // A script that does not come, or is no script; what a module throws before the page stands.
  addEventListener(
    'error',
    function (event) {
      var element = event.target;
      if (element && element.tagName === 'SCRIPT') tell('file', (element.src || '').replace(/^.*\//, ''));
      else if (event.message) tell('start', event.message + '.');
    },
    true,
  );
  addEventListener('unhandledrejection', function (event) {
    tell('start', String((event.reason && event.reason.message) || event.reason) + '.');
  });
})();
